#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"

namespace wormdrive {

void add_data_commands(CommandSet& commands) {
  commands.begin_group("Explain measured data");
  auto [command, options] =
      commands.add("diagnose", "find the effects that a scenario lacks to predict measured data", diagnose_command);
  add_scenario_options(command, options.scenario);
  command
      .add_option(
          "data", options.data,
          "recordings over time, records at constant speed or a break-in table (.csv, .mat, .h5), recognised by "
          "their columns; several files of one kind are diagnosed together")
      ->required();
  add_repeated(command, "--since", options.since, "FILE",
               "data of the same drive from before: what has changed since then; may be repeated");
  add_repeated(command, "--load", options.loads, "FILE:KEY=VALUE",
               "load of a recording if it is not that of the scenario: --load heavy.csv:mass_kg=0.9; may be repeated");
  command.add_option("-o,--output", options.output, "folder for the results")->required();
  command.add_option("--seed", options.seed, "seed of the bootstrap")
      ->check(CLI::Range(0.0, 9007199254740992.0, "NOT NEGATIVE"))
      ->capture_default_str();
  command
      .add_option("--draws", options.draws,
                  "fit a recording anew so many times, with its blocks weighted at random, so that uncertainty.toml "
                  "draws these fits instead of a normal distribution")
      ->check(CLI::Range(10U, 1000000U, "10 TO 1000000"));
  add_threads(command, options.threads);
  command.add_flag_callback(
      "--no-pictures", [&chosen = options] { chosen.pictures = false; }, "do not draw pictures");
  add_force(command, options.replace);
}

}  // namespace wormdrive
