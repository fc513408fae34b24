#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/describe/drive.hpp"
#include "cli/replay_trial.hpp"
#include "cli/run_and_write.hpp"
#include "description/build_control.hpp"
#include "description/diagnostics.hpp"
#include "events/simulation_failure.hpp"
#include "sweep/file/so_far.hpp"

namespace wormdrive {
namespace {

struct ReplayOptions {
  std::string sweep;
  std::uint64_t trial = 0;
  std::string output;
  Replace replace = Replace::same_kind;
  bool quiet = false;
  std::string command_line;
};

Trial stored(const SweepReader& sweep, std::uint64_t index) {
  if (!sweep.has(index)) {
    const TrialRange range = sweep.range();
    reject({sweep.path()}, fmt::format("does not contain trial {}; it contains {} of the trials {} to {}", index,
                                       sweep.trials(), range.first, range.end - 1));
  }
  return sweep.read({index, index + 1}).front();
}

/// The first metric of which a bit is another one than in the sweep.
std::string difference(const Study& study, const Trial& trial, const Outcome& outcome) {
  for (std::size_t k = 0; k < study.metrics.size(); ++k) {
    const double now = study.metrics[k].of(outcome);
    const bool neither = std::isnan(now) && std::isnan(trial.metrics[k]);
    if (!neither && std::bit_cast<std::uint64_t>(now) != std::bit_cast<std::uint64_t>(trial.metrics[k]))
      return fmt::format("{} = {}, but {} in the sweep", study.metrics[k].name, now, trial.metrics[k]);
  }
  return "";
}

}  // namespace

void replay_trial(const SweepReader& sweep, std::uint64_t index, const std::string& output, const RunOptions& options) {
  const Trial trial = stored(sweep, index);
  if (trial.status == TrialStatus::refused)
    reject({sweep.path()}, fmt::format("trial {} was refused and has no trajectory: {}", index, trial.reason));
  Trials trials(sweep.study());
  Scenario scenario = trials.scenario(index);
  scenario.title = fmt::format("{}, trial {}", sweep.study().title, index);
  OwnMeters meters(sweep.study().own_metrics, scenario);
  const Outcome outcome{run_and_write(scenario, output, options, meters.listeners()), lemma1_conditions(scenario),
                        meters.values()};
  if (const std::string other = difference(sweep.study(), trial, outcome); !other.empty())
    throw SimulationFailure(fmt::format(
        "trial {} gives another result: {}; was {} made by another version or on another kind of processor?", index,
        other, sweep.path()));
}

namespace {

int replay_command(const ReplayOptions& options) {
  reject_overwriting(options.output, options.sweep);
  RunOptions run;
  run.scenario.quiet = options.quiet;
  run.scenario.command_line = options.command_line;
  run.replace = options.replace;
  const SweepSoFar so_far(options.sweep);
  replay_trial(SweepReader(so_far.path()), options.trial, options.output, run);
  if (!options.quiet) print_item("replay", "every metric equals that of the sweep to the last bit");
  return 0;
}

}  // namespace

void add_replay(CommandSet& commands) {
  auto [command, options] =
      commands.add("replay", "run one trial of a sweep again and write its trajectory", replay_command);
  command.add_option("sweep", options.sweep, "result of a sweep (.h5)")->required();
  command.add_option("--trial", options.trial, "index of the trial, counted from 0")->required();
  command.add_option("-o,--output", options.output, "result file of the run")->required();
  add_quiet(command, options.quiet);
  add_force(command, options.replace);
}

}  // namespace wormdrive
