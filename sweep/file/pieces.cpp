#include "sweep/file/pieces.hpp"

#include <algorithm>

namespace wormdrive {

SweepPieces::SweepPieces(const std::vector<std::string>& paths, bool while_written) {
  for (const std::string& path : paths) {
    files.push_back(std::make_unique<SweepReader>(path, while_written));
    for (const TrialRange& range : files.back()->present()) in_order.push_back({range, files.back().get()});
  }
  std::stable_sort(in_order.begin(), in_order.end(),
                   [](const SweepPiece& a, const SweepPiece& b) { return a.range.first < b.range.first; });
}

}  // namespace wormdrive
