#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/describe/drive.hpp"
#include "cli/replay_trial.hpp"
#include "sweep/summary/summary.hpp"

namespace wormdrive {
namespace {

/// The trials that the study names and that the file has; the worst of those that are done only where the file has all.
std::set<std::uint64_t> wanted(const SweepReader& sweep) {
  const Kept& kept = sweep.study().kept;
  std::set<std::uint64_t> trials;
  for (const std::uint64_t trial : kept.trials)
    if (sweep.has(trial)) trials.insert(trial);
  const bool has_all = sweep.study().may_end_early() ? sweep.complete() : sweep.trials() == sweep.study().trials();
  if (kept.worst > 0 && has_all)
    for (const Trial& trial :
         summarise(sweep, {.ranked_by = kept.worst_by, .worst = static_cast<unsigned>(kept.worst), .done_only = true})
             .worst)
      trials.insert(trial.index);
  return trials;
}

}  // namespace

void keep_trajectories(const std::string& path, const std::string& command_line, bool quiet, Replace replace) {
  const SweepReader sweep(path);
  RunOptions options;
  options.scenario.quiet = true;
  options.scenario.command_line = command_line;
  options.replace = replace;
  const std::filesystem::path file(path);
  std::vector<std::uint64_t> kept;
  for (const std::uint64_t trial : wanted(sweep)) {
    if (const TrialStatus status = sweep.read({trial, trial + 1}).front().status; status != TrialStatus::done) {
      if (!quiet) print_item("kept", fmt::format("no trajectory of trial {}: it was {}", trial, name(status)));
      continue;
    }
    const auto output = file.parent_path() / fmt::format("{}_trial_{}.h5", file.stem().string(), trial);
    replay_trial(sweep, trial, output.string(), options);
    kept.push_back(trial);
  }
  if (!quiet && !kept.empty())
    print_item("kept", fmt::format("trial{} {} as {}_trial_INDEX.h5", kept.size() == 1 ? "" : "s",
                                   fmt::join(kept, ", "), file.stem().string()));
}

}  // namespace wormdrive
