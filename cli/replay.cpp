#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/describe.hpp"
#include "cli/run_and_write.hpp"
#include "events/halt.hpp"
#include "scenarios/build_control.hpp"
#include "scenarios/faults.hpp"
#include "sweep/sweep_file.hpp"

namespace wormdrive {
namespace {

Trial stored(const SweepReader& sweep, std::uint64_t index) {
  if (!sweep.has(index)) {
    const TrialRange range = sweep.range();
    refuse({sweep.path()}, fmt::format("holds no trial {}; {} of {} to {} are there", index, sweep.trials(),
                                       range.first, range.end - 1));
  }
  return sweep.read({index, index + 1}).front();
}

/// The first metric of which a bit is another one than in the sweep.
std::string difference(const Study& study, const Trial& trial, const Outcome& outcome) {
  for (std::size_t k = 0; k < study.metrics.size(); ++k) {
    const double now = study.metrics[k].of(outcome);
    const bool neither = std::isnan(now) && std::isnan(trial.metrics[k]);
    if (!neither && std::bit_cast<std::uint64_t>(now) != std::bit_cast<std::uint64_t>(trial.metrics[k]))
      return fmt::format("{} = {}, in the sweep {}", study.metrics[k].name, now, trial.metrics[k]);
  }
  return "";
}

}  // namespace

int replay_command(const ReplayOptions& options) {
  refuse_to_overwrite(options.output, options.sweep);
  const SweepReader sweep(options.sweep);
  const Trial trial = stored(sweep, options.trial);
  if (trial.status == TrialStatus::refused)
    refuse({options.sweep}, fmt::format("trial {} was not run: {}", options.trial, trial.reason));
  Trials trials(sweep.study());
  Scenario scenario = trials.scenario(options.trial);
  scenario.title = fmt::format("{}, trial {}", sweep.study().title, options.trial);
  RunOptions run;
  run.scenario.quiet = options.quiet;
  run.scenario.command_line = options.command_line;
  const Outcome outcome{run_and_write(scenario, options.output, run), lemma1_conditions(scenario)};
  if (const std::string other = difference(sweep.study(), trial, outcome); !other.empty())
    throw Halt(fmt::format("trial {} came out differently: {}; was {} made by this program on this kind of machine?",
                           options.trial, other, options.sweep));
  if (!options.quiet) print_item("replay", "every metric is that of the sweep, to the last bit");
  return 0;
}

}  // namespace wormdrive
