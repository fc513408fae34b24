#pragma once
#include <memory>
#include <string>
#include <vector>

#include "sweep/file/sweep_file.hpp"

namespace wormdrive {

/// Trials one after the other that a file has.
struct SweepPiece {
  TrialRange range;
  const SweepReader* file;
};

/// What several files have of a sweep.
struct SweepPieces {
  /// Throws InputFault if one cannot be read. while_written: another program may be writing them.
  explicit SweepPieces(const std::vector<std::string>& paths, bool while_written = false);

  std::vector<std::unique_ptr<SweepReader>> files;
  std::vector<SweepPiece> in_order;  ///< of the trials
};

}  // namespace wormdrive
