#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bindings/fmi/export_fmu.hpp"
#include "bindings/fmi/plant_parameters.hpp"
#include "bindings/fmi/variables.hpp"
#include "cli/commands.hpp"
#include "cli/describe/drive.hpp"
#include "core/elastic/elastic_teeth.hpp"
#include "description/diagnostics.hpp"
#include "simulation/load_scenario.hpp"

namespace wormdrive {

int fmu_command(const FmuOptions& options) {
  const Scenario scenario = load_scenario(options.scenario.file, options.scenario.overrides, Purpose::run);
  if (const auto why = not_exportable(scenario)) reject({options.scenario.file}, *why);
  const std::string output = options.output.empty() ? default_output(options.scenario.file, ".fmu") : options.output;
  reject_overwriting(output, options.scenario.file);
  export_fmu(scenario, output, options.replace);
  const InterfaceNames ports(has_elastic_teeth(scenario.effects));
  int parameters = 0;
  for_each_plant_parameter(scenario, [&](const std::string&, const auto&, const double&) { ++parameters; });
  if (options.scenario.json)
    print_json({{"title", scenario.title},
                {"output", output},
                {"states", ports.states.size()},
                {"event_indicators", ports.indicators.size()},
                {"parameters", parameters}});
  if (options.scenario.json || options.scenario.quiet) return 0;
  fmt::print("{}\n", scenario.title);
  print_item("fmu", fmt::format("FMI 2.0, model exchange: {} states, {} event indicators, {} parameters",
                                ports.states.size(), ports.indicators.size(), parameters));
  if (scenario.control || !scenario.motor.terms.empty())
    print_item("outside", fmt::format("{}: motor_torque is the input, set by the importing tool",
                                      scenario.control ? "[controller]" : "[motor.torque]"));
  print_item("wrote", output);
  return 0;
}

}  // namespace wormdrive
