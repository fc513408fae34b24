#include "sweep/file/merge.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "description/diagnostics.hpp"
#include "sweep/file/pieces.hpp"
#include "sweep/file/resume.hpp"

namespace wormdrive {
namespace {

using Shards = std::vector<std::unique_ptr<SweepReader>>;

std::string trials(TrialRange range) {
  return range.size() == 1 ? fmt::format("trial {}", range.first)
                           : fmt::format("trials {} to {}", range.first, range.end - 1);
}

void reject_unrelated_shards(const Shards& shards) {
  Diagnostics faults;
  const SweepReader& first = *shards.front();
  for (const auto& shard : shards)
    if (const std::string why = shard->why_not_of(first); !why.empty())
      faults.add({shard->path()}, fmt::format("is not a shard of the same sweep as {}: {}", first.path(), why));
  if (const std::string why = first.why_not_of(first.study()); !why.empty())
    faults.add({first.path()}, fmt::format("cannot be merged: {}", why));
  faults.raise();
}

/// Tells of trials that nobody has: if one shard alone has room for them, it is not finished.
void tell_missing(const Shards& shards, const SweepReader& beside, std::string_view side, TrialRange range,
                  Diagnostics& faults) {
  const auto has_room = [&](const auto& shard) {
    return shard->range().first <= range.first && range.first < shard->range().end;
  };
  const auto owner = std::find_if(shards.begin(), shards.end(), has_room);
  if (std::count_if(shards.begin(), shards.end(), has_room) == 1)
    faults.add({(*owner)->path()}, fmt::format("contains only {} of {} trials; finish it with --resume",
                                               (*owner)->trials(), (*owner)->range().size()));
  else
    faults.add({beside.path()}, fmt::format("no shard contains {} {} it", trials(range), side));
}

/// Whether an older merge of the same sweep is there: nothing that it holds would be lost.
bool holds_same_sweep(const std::string& output, const SweepReader& shard) {
  try {
    return std::filesystem::exists(output) && !std::filesystem::exists(output + ".part") &&
           SweepReader(output).why_not_of(shard).empty();
  } catch (const InputFault&) {
    return false;
  }
}

/// What the shards have, in the order of the trials, every one before an end once; every fault is told.
std::vector<SweepPiece> each_once(const SweepPieces& shards, std::uint64_t end) {
  std::vector<SweepPiece> pieces;
  for (const auto& [range, shard] : shards.in_order)
    if (range.first < end) pieces.push_back({{range.first, std::min(range.end, end)}, shard});
  Diagnostics faults;
  std::uint64_t next = 0;
  for (const auto& [range, shard] : pieces) {
    if (range.first < next)
      faults.add({shard->path()},
                 fmt::format("another shard also contains {}", trials({range.first, std::min(next, range.end)})));
    if (range.first > next) tell_missing(shards.files, *shard, "before", {next, range.first}, faults);
    next = std::max(next, range.end);
  }
  const SweepReader& last = pieces.empty() ? *shards.files.front() : *pieces.back().file;
  if (next < end) tell_missing(shards.files, last, "after", {next, end}, faults);
  faults.raise();
  return pieces;
}

}  // namespace

std::uint64_t merge_shards(const std::vector<std::string>& paths, const std::string& output, OutputLock lock,
                           const std::string& command_line, Replace replace, std::optional<std::uint64_t> early_end) {
  const SweepPieces shards(paths);
  const SweepReader& first = *shards.files.front();
  reject_unrelated_shards(shards.files);
  const Study& study = first.study();
  const std::uint64_t end = early_end.value_or(study.trials());
  const std::vector<SweepPiece> pieces = each_once(shards, end);
  if (holds_same_sweep(output, first)) replace = Replace::anything;
  const OpenSweep merged =
      open_sweep(output, std::move(lock), study, {0, study.trials()}, command_line, false, replace);
  try {
    merged.file->copy(pieces);
    std::vector<RefereeVerdict> verdicts;
    for (const auto& shard : shards.files)
      for (const RefereeVerdict& verdict : shard->verdicts())
        if (verdict.trial < end) verdicts.push_back(verdict);
    merged.file->write(verdicts);
    if (early_end) merged.file->end_before(end);
    merged.file->finish();
  } catch (...) {
    std::error_code ignored;  // the shards have all of it
    std::filesystem::remove(merged.file->part_path(), ignored);
    throw;
  }
  return end;
}

}  // namespace wormdrive
