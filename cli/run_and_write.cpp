#include "cli/run_and_write.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/describe/control.hpp"
#include "cli/describe/drive.hpp"
#include "cli/describe/teeth.hpp"
#include "cli/progress.hpp"
#include "cli/shell_words.hpp"
#include "core/elastic/elastic_teeth.hpp"
#include "description/toml/write_scenario.hpp"
#include "events/simulation_failure.hpp"
#include "simulation/write_run.hpp"

namespace wormdrive {
namespace {

nlohmann::json as_json(const Scenario& scenario, const RunSummary& summary, const std::string& output) {
  nlohmann::json result{{"title", scenario.title},           {"output", output},
                        {"warnings", warnings(scenario)},    {"solver", describe_solver(scenario.run)},
                        {"steps", summary.statistics.steps}, {"evaluations", summary.statistics.evaluations},
                        {"gear_angle", summary.end.theta_g}, {"gear_speed", summary.end.omega_g}};
  const RunContents contents = contents_of(scenario);
  for (const EventKind kind : event_kinds)
    if (can_happen(kind, contents))
      result["events"][std::string(name(kind))] = summary.events[static_cast<std::size_t>(kind)];
  if (summary.control) result["control"] = as_json(*summary.control);
  if (summary.audit)
    result["audit"] = {{"guards", summary.audit->guards},
                       {"events", summary.audit->events},
                       {"missed", summary.audit->missed()},
                       {"not_confirmed", static_cast<long>(summary.audit->findings.size()) - summary.audit->missed()},
                       {"largest_time_error_s", summary.audit->largest_time_error},
                       {"largest_angle_error", summary.audit->largest_angle_error},
                       {"largest_speed_error", summary.audit->largest_speed_error}};
  return result;
}

/// With a bar of progress; what there is stays where the run cannot go on.
RunSummary run_in_sight(RunFile& file, const Scenario& scenario, const RunOptions& options, RunListeners listeners) {
  Progress progress(scenario.run.duration, options.scenario.quiet || options.scenario.json);
  listeners.time = [&](double t) { progress.at(t); };
  listeners.audit = options.audit;
  try {
    return run_into(file, scenario, std::move(listeners));
  } catch (const SimulationFailure& halt) {
    file.file().keep();
    throw SimulationFailure(fmt::format("{}; the run up to there is in {}", halt.what(), file.file().part_path()));
  }
}

}  // namespace

RunSummary run_into(RunFile& file, const Scenario& scenario, RunListeners listeners) {
  write_drive(file.file().file(), scenario);
  listeners.rows = [&file, also = std::move(listeners.rows)](const Trajectory& part) {
    file.append(part);
    if (also) also(part);
  };
  listeners.samples = [&file, also = std::move(listeners.samples)](const std::vector<ControlRecord>& part) {
    file.append(part);
    if (also) also(part);
  };
  RunSummary summary = run_scenario(scenario, listeners);
  if (summary.control) file.describe(*summary.control);
  file.finish(describe_solver(scenario.run), summary.statistics);
  return summary;
}

RunSummary run_and_write(const Scenario& scenario, const std::string& output, const RunOptions& options,
                         RunListeners listeners) {
  const bool talk = !options.scenario.quiet && !options.scenario.json;
  if (talk) {
    fmt::print("{}\n", scenario.title);
    if (const std::string mesh = describe_mesh(scenario); !mesh.empty()) print_item("regime", mesh);
    if (has_elastic_teeth(scenario.effects)) print_item("teeth", describe_teeth(scenario));
    for (const std::string& warning : warnings(scenario)) print_item("warning", warning);
  }
  RunFile file(output, {"run", scenario.title, to_toml(scenario), options.scenario.command_line}, scenario.axis,
               contents_of(scenario), options.replace);
  RunSummary summary = run_in_sight(file, scenario, options, std::move(listeners));
  if (options.scenario.json) print_json(as_json(scenario, summary, output));
  if (!talk) return summary;
  print_item("run",
             fmt::format("{:g} s with {}, {} evaluations, {}", scenario.run.duration, describe_solver(scenario.run),
                         summary.statistics.evaluations, describe_events(summary)));
  if (summary.control) print_control(*summary.control);
  if (summary.audit) print_item("audit", describe_audit(*summary.audit, scenario));
  print_item("wrote", fmt::format("{}    see it: wormdrive plot {}", output, shell_path(output)));
  return summary;
}

}  // namespace wormdrive
