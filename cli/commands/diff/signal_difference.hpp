#pragma once
#include <string>
#include <utility>
#include <vector>

#include "cli/commands/diff/paired_rows.hpp"
#include "cli/commands/sweep/diff_sweeps.hpp"

namespace wormdrive {

/// How one signal of two results compares.
struct SignalDifference {
  std::string signal;
  double largest = 0.0, allowed = 0.0;
  RowPlace at = {};        ///< of the largest difference; 0 where there is none
  bool attribute = false;  ///< of a table or of the file, not a column
  bool too_large() const { return !(largest <= allowed); }
};

/// The rows of two columns that are compared.
struct ComparedRows {
  RowPlaces places = {};  ///< in the first result
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::vector<bool> left_out = {};  ///< pairs whose difference does not count; empty: none
};

/// The allowed difference follows from the finite values alone; no size allows that a value is infinite or not a number
/// in one result only.
SignalDifference signal_difference(const std::string& signal, const std::vector<double>& first,
                                   const std::vector<double>& second, const ComparedRows& rows,
                                   const DiffOptions& allowed);

/// How much a signal changes at the most within a time, as far as its rows tell.
double largest_change(const std::vector<double>& times, const std::vector<double>& values, double within);

}  // namespace wormdrive
