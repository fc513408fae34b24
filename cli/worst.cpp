#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/describe.hpp"
#include "cli/run_and_write.hpp"
#include "cli/shell_words.hpp"
#include "scenarios/build_control.hpp"
#include "scenarios/second_opinion.hpp"
#include "sweep/threads.hpp"
#include "sweep/worst_case.hpp"

namespace wormdrive {
namespace {

/// What CVODE says of the worst drive: with its own controller, and under the torque of the fast path.
std::string second_opinion_on(const Scenario& scenario, const Study& study, const std::string& metric,
                              const Unit& unit) {
  Scenario again = scenario;
  again.run.solver = SolverKind::cvode;
  const Outcome outcome{run_scenario(again), lemma1_conditions(again)};
  std::string said;
  for (const Metric& m : study.metrics)
    if (m.name == metric) said = fmt::format("with cvode {} {:.6g} {}", metric, m.of(outcome), unit.symbol);
  if (scenario.run.solver == SolverKind::cvode) return said;
  const Disagreement found = second_opinion(scenario);
  return said + fmt::format("; under the same torque angles within {:.2g} rad", found.angle);
}

}  // namespace

int worst_command(const WorstOptions& options) {
  refuse_to_overwrite(options.output, options.sweep);
  const SweepReader sweep(options.sweep);
  const Study& study = sweep.study();
  const WorstCase worst =
      find_worst(sweep, {options.metric, options.evaluations, options.tail, threads_for(options.threads)});
  Trials trials(study);
  trials.at(worst.point);
  Scenario scenario = trials.scenario();
  scenario.title = fmt::format("{}, worst case by {}", study.title, worst.metric);
  RunOptions run;
  run.scenario.quiet = true;
  run.scenario.command_line = options.command_line;
  run_and_write(scenario, options.output, run);
  if (options.quiet) return 0;
  fmt::print("{}\n", scenario.title);
  print_item("worst", fmt::format("{} {:.6g} {} in {} runs; the sweep's worst, trial {}, has {:.6g} {}", worst.metric,
                                  worst.value, worst.unit.symbol, worst.evaluations, worst.trial, worst.before,
                                  worst.unit.symbol));
  for (std::size_t k = 0; k < study.parameters.size(); ++k)
    print_item(k == 0 ? "with" : "", fmt::format("{} {:.6g} {}", study.parameters[k].name, worst.found.parameters[k],
                                                 study.parameters[k].si_unit.symbol));
  print_item("referee", second_opinion_on(scenario, study, worst.metric, worst.unit));
  print_item("wrote", fmt::format("{}    see it: wormdrive plot {}", options.output, shell_path(options.output)));
  return 0;
}

}  // namespace wormdrive
