#pragma once
#include "output/hdf5/stored_table.hpp"
#include "sweep/study/study.hpp"
#include "sweep/trial_range.hpp"

namespace wormdrive {

/// What is stored of the trials of a sweep.
struct StoredTrials {
  TrialRange range;  ///< for which it has room
  StoredTable trials, referee;
};

/// Looks at all that readers of a sweep rely on: that it has room for trials of its study and no others, and that every
/// row that is there, whatever its place among those that are not yet, has its own index, a status, one of the reasons
/// that the file has, and numbers as parameters; and at all that a sweep that goes on writes to: room for the texts of
/// /reasons and for the tables of /summary. Throws ReadFault.
StoredTrials check_sweep(hid_t file, const Study& study);

}  // namespace wormdrive
