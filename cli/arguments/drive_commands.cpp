#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"

namespace wormdrive {
namespace {

/// Of a command that prints what it finds.
void add_optional_output(CLI::App& command, std::string& output) {
  command.add_option("-o,--output", output, "result file; default: none is written");
}

void add_max_load(CLI::App& command, std::optional<double>& max_load) {
  command
      .add_option("--max-load", max_load,
                  "largest load torque [N m]; default: 1.5 times that of the gravity arm or of the scenario's run")
      ->check(finite_number(false));
}

void add_new(CommandSet& commands) {
  auto [command, options] = commands.add("new", "write a commented scenario or study to start from", new_command);
  command.add_option("file", options.file, "scenario or study to write (.toml)")->required();
  options.kind = new_kinds().front();
  command.add_option("--kind", options.kind, "what the file describes")
      ->check(CLI::IsMember(new_kinds()))
      ->capture_default_str();
}

void add_list(CommandSet& commands) {
  auto [command, options] =
      commands.add("list", "list effects, loads, torques, controllers, references or scenarios", list_command);
  command.add_option("topic", options.topic, "what to list; effects.md prints the effects as a Markdown page")
      ->required()
      ->check(CLI::IsMember({"effects", "effects.md", "loads", "torques", "controllers", "references", "scenarios"}));
}

void add_check(CommandSet& commands) {
  auto [command, options] =
      commands.add("check", "print the parameters of a scenario, derived quantities and warnings", check_command);
  add_scenario_options(command, options);
}

void add_schema(CommandSet& commands) {
  auto [command, options] =
      commands.add("schema", "print the JSON schema of scenarios or studies, for editors", schema_command);
  command.add_option("--kind", options.kind, "what the schema is of")
      ->check(CLI::IsMember({"scenario", "study"}))
      ->capture_default_str();
}

void add_run(CommandSet& commands) {
  auto [command, options] = commands.add("run", "simulate a scenario and write the result (HDF5)", run_command);
  add_scenario_options(command, options.scenario);
  command.add_option("-o,--output", options.output, "result file; default: the scenario's name with .h5");
  command.add_flag("--audit", options.audit, "integrate again with another method and look for missed events");
  add_force(command, options.replace);
}

void add_view(CommandSet& commands) {
  auto [command, options] =
      commands.add("view", "look at a scenario in a browser, with sliders that run it again", view_command);
  add_scenario_options(command, options.scenario);
  command.add_option(
      "--vary", options.vary,
      "a number with a slider: table.key or table.key=low..high; default: all numbers, from half to twice");
  command.add_option("--port", options.port, "port of the loopback address; 0: any that is free")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
}

void add_statics(CommandSet& commands) {
  auto [command, options] = commands.add("statics", "compute the locking regime and break-in torques", statics_command);
  add_scenario_options(command, options.scenario);
  add_optional_output(command, options.output);
  add_max_load(command, options.max_load);
  command.add_option("--points", options.points, "number of load torques from -max to +max")
      ->check(CLI::Range(3, 100000))
      ->capture_default_str();
  add_force(command, options.replace);
}

void add_steady(CommandSet& commands) {
  auto [command, options] = commands.add("steady", "compute the motor torque at constant speed", steady_command);
  add_scenario_options(command, options.scenario);
  add_optional_output(command, options.output);
  command.add_option("--data", options.data,
                     "records to compare with the model: a file (.csv, .mat, .h5) with the columns record, "
                     "worm_speed_rad_per_s, motor_torque_Nm");
  command
      .add_option("--max-speed", options.max_speed,
                  "largest worm speed [rad/s]; default: that of the data, or of the scenario's run")
      ->check(finite_number(false));
  command.add_option("--points", options.points, "number of speeds in each direction")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  add_force(command, options.replace);
}

void add_efficiency(CommandSet& commands) {
  auto [command, options] =
      commands.add("efficiency", "compute the efficiency over worm speed and load torque", efficiency_command);
  add_scenario_options(command, options.scenario);
  add_optional_output(command, options.output);
  command
      .add_option("--max-speed", options.max_speed, "largest worm speed [rad/s]; default: that of the scenario's run")
      ->check(finite_number(false));
  add_max_load(command, options.max_load);
  command.add_option("--points", options.points, "number of speeds in each direction, and of loads of each sign")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  add_force(command, options.replace);
}

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

}  // namespace

void add_drive_commands(CommandSet& commands) {
  commands.begin_group("Describe a drive");
  add_new(commands);
  add_list(commands);
  add_check(commands);
  add_schema(commands);
  commands.begin_group("Simulate it");
  add_run(commands);
  add_view(commands);
  add_statics(commands);
  add_steady(commands);
  add_efficiency(commands);
  add_fmu(commands);
}

}  // namespace wormdrive
