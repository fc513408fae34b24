#include "sweep/merge.hpp"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "scenarios/faults.hpp"

namespace wormdrive {
namespace {

using Shards = std::vector<std::unique_ptr<SweepReader>>;

std::string trials(std::uint64_t first, std::uint64_t end) {
  return end == first + 1 ? fmt::format("trial {}", first) : fmt::format("trials {} to {}", first, end - 1);
}

/// Shards in the order of their trials; every fault is told.
Shards checked(const std::vector<std::string>& paths) {
  Shards shards;
  for (const std::string& path : paths) shards.push_back(std::make_unique<SweepReader>(path));
  Faults faults;
  const SweepReader& first = *shards.front();
  for (const auto& shard : shards) {
    if (const std::string why = shard->why_not_of(first); !why.empty())
      faults.add({shard->path()}, fmt::format("is not a shard of the same sweep as {}: {}", first.path(), why));
    else if (!shard->complete())
      faults.add({shard->path()},
                 fmt::format("holds {} of {} trials; finish it with --resume", shard->rows(), shard->range().size()));
  }
  faults.raise();
  std::sort(shards.begin(), shards.end(),
            [](const auto& a, const auto& b) { return a->range().first < b->range().first; });
  std::uint64_t next = 0;
  for (const auto& shard : shards) {
    const TrialRange range = shard->range();
    if (range.first < next)
      faults.add({shard->path()},
                 fmt::format("{} stand in another shard too", trials(range.first, std::min(next, range.end))));
    if (range.first > next)
      faults.add({shard->path()}, fmt::format("{} before it stand in no shard", trials(next, range.first)));
    next = std::max(next, range.end);
  }
  if (const std::uint64_t all = first.study().trials(); next < all)
    faults.add({shards.back()->path()}, fmt::format("{} after it stand in no shard", trials(next, all)));
  faults.raise();
  return shards;
}

}  // namespace

std::uint64_t merge_shards(const std::vector<std::string>& paths, const std::string& output,
                           const std::string& command_line) {
  const Shards shards = checked(paths);
  const Study& study = shards.front()->study();
  SweepFile file(output, study, {0, study.trials()}, command_line);
  for (const auto& shard : shards) copy_rows(*shard, file);
  file.finish();
  return study.trials();
}

}  // namespace wormdrive
