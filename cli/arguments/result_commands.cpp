#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"

namespace wormdrive {
namespace {

void add_plot(CommandSet& commands) {
  auto [command, options] = commands.add("plot", "draw a result as a picture (PNG)", plot_command);
  command
      .add_option(
          "files", options.files,
          "results (.h5); one picture shows a statics result with the break-aways of runs, a sweep with runs of "
          "its trials, or several runs over the motor torque")
      ->required();
  command.add_option("--over", options.over, "draw runs over the motor torque instead of time")
      ->check(CLI::IsMember({"motor_torque"}));
  command.add_option("--part", options.part, "which picture of a diagnosis; default: prediction")
      ->check(CLI::IsMember({"prediction", "residual", "ranking", "certificate"}));
  command.add_option("-o,--output", options.output, "picture; default: the result's name with .png");
  add_force(command, options.replace);
}

void add_report(CommandSet& commands) {
  auto [command, options] = commands.add("report", "write a result as one HTML page", report_command);
  command.add_option("file", options.file, "result (.h5), or the folder of a diagnosis")->required();
  command.add_option("-o,--output", options.output, "page; default: the result's name with .html");
  add_force(command, options.replace);
}

void add_diff(CommandSet& commands) {
  auto [command, options] =
      commands.add("diff", "compare two results; exit code 0 if they agree, 1 if they differ", diff_command);
  command.add_option("first", options.first, "result (.h5)")->required();
  command.add_option("second", options.second, "result (.h5)")->required();
  const CLI::Validator not_negative = finite_number(true);
  command
      .add_option("--relative", options.relative, "allowed difference, as a share of the signal's largest magnitude")
      ->check(not_negative)
      ->capture_default_str();
  command.add_option("--absolute", options.absolute, "allowed difference in addition, in the unit of the signal")
      ->check(not_negative)
      ->capture_default_str();
  command.add_option("--time", options.time, "allowed difference of event times [s]")
      ->check(not_negative)
      ->capture_default_str();
  command.add_flag("-q,--quiet", options.quiet, "print nothing; the exit code is the answer");
  add_json(command, options.json);
}

void add_export(CommandSet& commands) {
  auto [command, options] =
      commands.add("export", "write a run as CSV or as a MAT-file, or a sweep as CSV", export_command);
  command.add_option("file", options.file, "result of a run or of a sweep (.h5)")->required();
  CLI::Option& csv = *command.add_flag(
      "--csv", options.csv,
      "one file per table: NAME.csv has the trajectory, NAME_events.csv the events, NAME_controller.csv the "
      "samples of a controller; of a sweep one table");
  command.add_flag("--mat", options.mat, "a run as one file (MAT, version 5) with a struct per table")->excludes(&csv);
  command.add_option("--what", options.what, "which table of a sweep")
      ->check(CLI::IsMember({"trials", "summary"}))
      ->capture_default_str();
  command.add_option("-o,--output", options.output,
                     "file; default: the run's name with .csv or .mat, of a sweep standard output");
  command.add_option("--metric", options.metric,
                     "metric that ranks the parameters of a summary; default: as in summary");
  command.add_flag("--done-only", options.done_only, "leave refused and halted trials out of a summary");
  add_quiet(command, options.quiet);
  add_force(command, options.replace);
}

}  // namespace

void add_result_commands(CommandSet& commands) {
  commands.begin_group("Look at results");
  add_plot(commands);
  add_report(commands);
  add_diff(commands);
  add_export(commands);
}

}  // namespace wormdrive
