#pragma once
#include <cstdint>
#include <numeric>
#include <vector>

namespace wormdrive {

/// Trials with first <= index < end.
struct TrialRange {
  std::uint64_t first{}, end{};
  std::uint64_t size() const { return end - first; }
};

inline std::uint64_t trials_in(const std::vector<TrialRange>& ranges) {
  return std::accumulate(ranges.begin(), ranges.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const TrialRange& range) { return sum + range.size(); });
}

/// Appends trials that follow the others, to the last range where they join it.
inline void extend(std::vector<TrialRange>& ranges, TrialRange more) {
  if (more.size() == 0) return;
  if (!ranges.empty() && ranges.back().end == more.first)
    ranges.back().end = more.end;
  else
    ranges.push_back(more);
}

/// Trials of a range that are in none of some ranges, which rise and do not overlap.
inline std::vector<TrialRange> outside(const std::vector<TrialRange>& present, TrialRange all) {
  std::vector<TrialRange> missing;
  std::uint64_t next = all.first;
  for (const TrialRange& range : present) {
    extend(missing, {next, range.first});
    next = range.end;
  }
  extend(missing, {next, all.end});
  return missing;
}

}  // namespace wormdrive
