#include <fmt/format.h>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/describe/drive.hpp"
#include "cli/describe/sweep.hpp"
#include "cli/run_and_write.hpp"
#include "cli/shell_words.hpp"
#include "description/build_control.hpp"
#include "description/diagnostics.hpp"
#include "description/keys.hpp"
#include "simulation/solver_cross_check.hpp"
#include "statistics/threads.hpp"
#include "sweep/worst_case.hpp"

namespace wormdrive {
namespace {

struct WorstOptions {
  std::string sweep;
  std::string metric;  ///< empty: the one by which trials are ranked
  std::uint64_t evaluations = 400;
  double tail = 1e-3;      ///< probability left out at either end of each parameter
  bool done_only = false;  ///< look among drives alone that run to the end
  Replace replace = Replace::same_kind;
  unsigned threads = 0;
  std::string output;
  bool quiet = false;
  std::string command_line;
};

/// What CVODE says of the worst drive: with its own controller, and under the torque of the fast path.
std::string second_opinion_on(const Scenario& scenario, const Study& study, const std::string& metric) {
  Scenario again = scenario;
  again.run.solver = SolverKind::cvode;
  OwnMeters meters(study.own_metrics, again);
  const Outcome outcome{run_scenario(again, meters.listeners()), lemma1_conditions(again), meters.values()};
  const Metric& m = study.metric(metric);
  const std::string said = "cvode: " + with_value(m, m.of(outcome));
  if (scenario.run.solver == SolverKind::cvode) return said;
  const Disagreement found = cross_check(scenario);
  return said + fmt::format("; under the same {}, {} agree within {:.2g} {}", in_words_of(scenario.axis, "torque"),
                            angles_on(scenario.axis), found.angle, units_on(scenario.axis, "rad"));
}

int worst_command(const WorstOptions& options) {
  reject_overwriting(options.output, options.sweep);
  reject_replacing(followed(options.output), "run", options.replace);  // before the search, which takes its time
  const SweepReader sweep(options.sweep);
  const Study& study = sweep.study();
  const WorstCase worst = find_worst(
      sweep, {options.metric, options.evaluations, options.tail, threads_for(options.threads), options.done_only});
  const std::string found = how_it_ended(study, worst.metric, worst.found),
                    before = fmt::format("trial {}", worst.before.index);
  if (worst.found.status == TrialStatus::refused)
    reject({options.sweep},
           fmt::format("{} is the worst but cannot run: {}; --done-only considers only drives that can",
                       worst.evaluations == 0 ? before : "a drive found in the uncertain box", worst.found.reason));
  Scenario scenario = worst.scenario;
  scenario.title = fmt::format("{}, worst case by {}", study.title, worst.metric);
  if (!options.quiet) {
    fmt::print("{}\n", scenario.title);
    print_item("worst", worst.evaluations == 0
                            ? fmt::format("{} of the sweep, {}; nothing can be worse", before, found)
                            : fmt::format("{} after {} runs; the worst of the sweep is {} with {}", found,
                                          worst.evaluations, before, how_it_ended(study, worst.metric, worst.before)));
    for (std::size_t k = 0; k < study.parameters.size(); ++k)
      print_item(k == 0 ? "with" : "", fmt::format("{} {:.6g}{}", study.parameters[k].name, worst.found.parameters[k],
                                                   in_unit(study.parameters[k].si_unit)));
  }
  RunOptions run;
  run.scenario.quiet = true;
  run.scenario.command_line = options.command_line;
  run.replace = options.replace;
  run_and_write(scenario, options.output, run);
  if (options.quiet) return 0;
  print_item("referee", second_opinion_on(scenario, study, worst.metric));
  print_item("wrote", fmt::format("{}    see it: wormdrive plot {}", options.output, shell_path(options.output)));
  return 0;
}

}  // namespace

void add_worst(CommandSet& commands) {
  auto [command, options] =
      commands.add("worst", "search the uncertain parameters of a sweep for the worst drive", worst_command);
  command.add_option("sweep", options.sweep, "result of a sweep (.h5)")->required();
  command.add_option("-o,--output", options.output, "result file of the worst run")->required();
  command.add_option("--metric", options.metric, "metric whose worst value is sought; default: as in summary");
  command.add_option("--evaluations", options.evaluations, "largest number of runs")
      ->check(CLI::Range(4, 1000000))
      ->capture_default_str();
  command.add_option("--tail", options.tail, "probability left out at either end of each parameter")
      ->check(CLI::Range(1e-12, 0.49))
      ->capture_default_str();
  command.add_flag("--done-only", options.done_only, "search only among drives that run to the end");
  add_threads(command, options.threads);
  add_quiet(command, options.quiet);
  add_force(command, options.replace);
}

}  // namespace wormdrive
