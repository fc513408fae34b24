#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/describe/control.hpp"
#include "cli/describe/drive.hpp"
#include "cli/describe/teeth.hpp"
#include "core/elastic/elastic_teeth.hpp"
#include "description/quantities.hpp"
#include "description/toml/write_scenario.hpp"
#include "description/warnings.hpp"
#include "simulation/load_scenario.hpp"

namespace wormdrive {
namespace {

void print(const std::vector<Quantity>& list) {
  for (const Quantity& q : list)
    fmt::print("  {:<36} {:>14.6g} {:<10} {}\n", q.name, q.value, q.unit == "1" ? "" : q.unit, q.meaning);
}

nlohmann::json as_json(const std::vector<Quantity>& list) {
  nlohmann::json result = nlohmann::json::object();
  for (const Quantity& q : list) result[q.name] = {{"value", q.value}, {"unit", q.unit}, {"meaning", q.meaning}};
  return result;
}

int check_command(const ScenarioOptions& options) {
  const Scenario scenario = load_scenario(options.file, options.overrides, Purpose::look);
  if (options.json) {
    print_json({{"title", scenario.title},
                {"parameters", as_json(parameters(scenario))},
                {"derived", as_json(derived(scenario))},
                {"regime", describe_mesh(scenario)},
                {"controller", design_as_json(scenario)},
                {"warnings", warnings(scenario)},
                {"scenario", to_toml(scenario)}});
    return 0;
  }
  if (options.quiet) return 0;
  fmt::print("{}\n\nparameters\n", scenario.title);
  print(parameters(scenario));
  if (const auto list = derived(scenario); !list.empty()) {
    fmt::print("\nderived quantities\n");
    print(list);
    fmt::print("\n");
    print_item("regime", describe_mesh(scenario));
    if (has_elastic_teeth(scenario.effects)) print_item("teeth", describe_teeth(scenario));
  }
  print_design(scenario);
  for (const std::string& warning : warnings(scenario)) print_item("warning", warning);
  return 0;
}

}  // namespace

void add_check(CommandSet& commands) {
  auto [command, options] =
      commands.add("check", "print the parameters of a scenario, derived quantities and warnings", check_command);
  add_scenario_options(command, options);
}

}  // namespace wormdrive
