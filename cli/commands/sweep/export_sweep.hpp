#pragma once
#include <string>

#include "output/replacing.hpp"

namespace wormdrive {

struct ExportOptions {
  std::string file;               ///< result of a run or of a sweep
  bool csv = false, mat = false;  ///< of a run: one of them
  std::string what = "trials";    ///< of a sweep: or "summary"
  std::string output;             ///< empty: named after the run; of a sweep standard output
  std::string metric;             ///< of the summary, as there
  bool done_only = false;
  bool quiet = false;
  Replace replace = Replace::same_kind;
};

/// Writes a table of a sweep as CSV.
int export_sweep(const ExportOptions& options);

}  // namespace wormdrive
