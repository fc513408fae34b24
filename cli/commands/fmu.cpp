#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bindings/fmi/archive/export_fmu.hpp"
#include "bindings/fmi/plant_parameters.hpp"
#include "bindings/fmi/variables.hpp"
#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/describe/drive.hpp"
#include "core/elastic/elastic_teeth.hpp"
#include "description/diagnostics.hpp"
#include "simulation/load_scenario.hpp"

namespace wormdrive {

namespace {

struct FmuOptions {
  ScenarioOptions scenario;
  int version = 2;             ///< of the standard, 2 or 3
  std::string kind = "plant";  ///< or "loop"
  std::string output;          ///< empty: named after the scenario
  Replace replace = Replace::same_kind;
};

/// The interface types of an FMU, and why it has not both.
std::string interface_types(const FmuModel& model) {
  const Offered has = offered(model);
  if (has.model_exchange && has.co_simulation) return "model exchange and co-simulation";
  if (has.model_exchange) return "model exchange only: CVODE, which elastic teeth need, is not inside";
  return model.kind == FmuKind::loop
             ? "co-simulation: everything is inside"
             : "co-simulation only: no solver of an importing tool remembers what is delayed or lags";
}

int fmu_command(const FmuOptions& options) {
  const Scenario scenario = load_scenario(options.scenario.file, options.scenario.overrides, Purpose::run);
  const FmuModel model = carried(scenario, options.kind == "loop" ? FmuKind::loop : FmuKind::plant);
  if (const auto why = not_exportable(model)) reject({options.scenario.file}, *why);
  const std::string output = options.output.empty() ? default_output(options.scenario.file, ".fmu") : options.output;
  reject_overwriting(output, options.scenario.file);
  export_fmu(model, options.version, output, options.replace);
  const Offered has = offered(model);
  const InterfaceNames ports(scenario.effects);
  const std::size_t indicators = has.model_exchange ? ports.indicators.size() : 0;
  const std::size_t parameters = plant_parameters(model.scenario).size();
  if (options.scenario.json)
    print_json({{"title", scenario.title},
                {"output", output},
                {"fmi", options.version},
                {"kind", options.kind},
                {"model_exchange", has.model_exchange},
                {"co_simulation", has.co_simulation},
                {"states", ports.states.size()},
                {"event_indicators", indicators},
                {"parameters", parameters}});
  if (options.scenario.json || options.scenario.quiet) return 0;
  fmt::print("{}\n", scenario.title);
  print_item("fmu", fmt::format("FMI {}.0, {}", options.version, interface_types(model)));
  print_item("has",
             fmt::format("{} states, {} event indicators, {} parameters", ports.states.size(), indicators, parameters));
  if (model.kind == FmuKind::plant && (scenario.control || !scenario.motor.terms.empty()))
    print_item("outside", fmt::format("{}: motor_torque is the input, set by the importing tool{}",
                                      scenario.control ? "[controller]" : "[motor.torque]",
                                      has.co_simulation ? "; --kind loop takes it in" : ""));
  if (elastic_teeth_inside && has_elastic_teeth(scenario.effects))
    print_item("windows", has.model_exchange
                              ? "model exchange only: CVODE, which elastic teeth need, is not in the library there"
                              : "none: CVODE, which elastic teeth need, is not in the library there");
  print_item("wrote", output);
  return 0;
}

}  // namespace

void add_fmu(CommandSet& commands) {
  auto [command, options] = commands.add(
      "fmu", "export the drive of a scenario as an FMU, a model for Simulink, Modelica and others", fmu_command);
  add_scenario_options(command, options.scenario);
  command.add_option("--fmi", options.version, "version of the standard FMI: 2 (default) or 3")
      ->check(CLI::IsMember({2, 3}));
  command
      .add_option("--kind", options.kind,
                  "plant: the motor torque is an input (default); loop: motor torque or controller are inside")
      ->check(CLI::IsMember({"plant", "loop"}));
  command.add_option("-o,--output", options.output, "FMU; default: the scenario's name with .fmu");
  add_force(command, options.replace);
}

}  // namespace wormdrive
