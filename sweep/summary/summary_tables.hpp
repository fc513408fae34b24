#pragma once
#include <string>

#include "output/hdf5/hdf5.hpp"
#include "sweep/summary/summary.hpp"

namespace wormdrive {

/// How many of the worst trials a sweep file lists.
inline constexpr unsigned worst_trials_listed = 10;

/// Adds the empty group /summary to a sweep file, with room for all that it will hold.
void create_summary_tables(hid_t file, const Study& study);

/// Throws ReadFault unless it is there with all its tables.
void check_summary_tables(hid_t file, const Study& study);

/// Fills it.
void write_summary_tables(hid_t file, const SweepSummary& summary, const Study& study);

}  // namespace wormdrive
