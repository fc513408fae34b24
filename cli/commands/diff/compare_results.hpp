#pragma once
#include <string>
#include <vector>

#include "cli/commands/diff/signal_difference.hpp"

namespace wormdrive {

/// How many rows of a table both results have, and how many one of them only.
struct TableRows {
  std::string table;
  std::size_t common = 0, first_only = 0, second_only = 0;
};

struct ResultComparison {
  std::vector<SignalDifference> signals;
  std::vector<TableRows> tables;
  std::vector<std::string> faults;  ///< differences that are not a matter of size
  std::vector<std::string> notes;   ///< what is no difference, but good to know
  std::size_t events = 0;           ///< that were compared

  std::size_t rows() const;  ///< that were compared
  bool differs() const;
};

/// Compares all tables of two results of the same kind, but for sweeps.
ResultComparison compare_results(const ResultFile& a, const ResultFile& b, const DiffOptions& allowed);

}  // namespace wormdrive
