#pragma once
#include <memory>
#include <string>
#include <vector>

#include "sweep/file/sweep_file.hpp"

namespace wormdrive {

/// What several files have of a sweep.
struct SweepPieces {
  /// Throws InputFault if one cannot be read. while_written: another program may be writing them.
  explicit SweepPieces(const std::vector<std::string>& paths, bool while_written = false);

  std::vector<std::unique_ptr<SweepReader>> files;
  std::vector<SweepPiece> in_order;  ///< of the trials
};

}  // namespace wormdrive
