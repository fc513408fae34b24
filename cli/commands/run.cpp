#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/run_and_write.hpp"
#include "simulation/load_scenario.hpp"

namespace wormdrive {
namespace {

int run_command(const RunOptions& options) {
  const Scenario scenario = load_scenario(options.scenario.file, options.scenario.overrides, Purpose::run);
  const std::string output = options.output.empty() ? default_output(options.scenario.file, ".h5") : options.output;
  reject_overwriting(output, options.scenario.file);
  run_and_write(scenario, output, options);
  return 0;
}

}  // namespace

void add_run(CommandSet& commands) {
  auto [command, options] = commands.add("run", "simulate a scenario and write the result (HDF5)", run_command);
  add_scenario_options(command, options.scenario);
  command.add_option("-o,--output", options.output, "result file; default: the scenario's name with .h5");
  command.add_flag("--audit", options.audit, "integrate again with another method and look for missed events");
  add_force(command, options.replace);
}

}  // namespace wormdrive
