#include <algorithm>
#include <cmath>
#include <csignal>
#include <iostream>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/help_arguments.hpp"
#include "cli/shell_words.hpp"
#include "description/diagnostics.hpp"
#include "description/keys.hpp"
#include "output/hdf5/part_file.hpp"
#include "output/program.hpp"

namespace {

using namespace wormdrive;

/// "wormdrive run 'my arm.toml'", as one could type it again.
std::string command_line(int argc, char** argv) {
  std::vector<std::string> words{"wormdrive"};
  for (int k = 1; k < argc; ++k) words.push_back(shell_word(argv[k]));
  return fmt::format("{}", fmt::join(words, " "));
}

/// An option that may be given several times, one value each.
CLI::Option* add_repeated(CLI::App& command, const std::string& name, std::vector<std::string>& values,
                          const std::string& type, const std::string& what) {
  return command.add_option(name, values, what)->type_name(type)->take_all()->allow_extra_args(false);
}

void add_scenario_options(CLI::App& command, ScenarioOptions& options) {
  command.add_option("scenario", options.file, "scenario (.toml), or a result file that carries one (.h5)")->required();
  add_repeated(command, "--set", options.overrides, "KEY=VALUE",
               "override a key, as in --set motor.torque.amplitude_Nm=0.06; of several terms --set "
               "motor.torque[1].amplitude_Nm=0.06; may be repeated");
  command.add_flag("-q,--quiet", options.quiet, "print faults only");
  command.add_flag("--json", options.json, "print the result as JSON");
}

/// CLI11 takes a misspelled command for a superfluous argument and asks for one.
std::optional<std::string> unknown_command(const CLI::App& app, int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "-";
  if (first.starts_with('-')) return std::nullopt;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), first) != names.end()) return std::nullopt;
  if (const auto meant = probably_meant(first, names))
    return fmt::format("wormdrive: error: unknown command '{}'; did you mean '{}'?", first, *meant);
  return fmt::format("wormdrive: error: unknown command '{}'; the commands are {}", first, fmt::join(names, ", "));
}

/// Help and version as CLI11 prints them; a fault on one line, with the command whose help has the answer.
int told(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error);
  std::string command = "wormdrive";
  for (const CLI::App* parsed : app.get_subcommands()) command += " " + parsed->get_name();
  std::cerr << fmt::format("{}: error: {}; see {} --help\n", command, error.what(), command);
  return bad_input;
}

/// A finite number that is greater than 0, or at least 0; CLI::PositiveNumber prints the largest double in full.
CLI::Validator number(bool zero_too) {
  const std::string rule = zero_too ? "of at least 0" : "greater than 0";
  return CLI::Validator(
      [zero_too, rule](const std::string& text) {
        double value = 0.0;
        const bool read = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
        return read && (value > 0.0 || (zero_too && value == 0.0)) ? "" : "'" + text + "' is not a number " + rule;
      },
      zero_too ? "NOT NEGATIVE" : "POSITIVE");
}
const CLI::Validator positive = number(false), not_negative = number(true);

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error that write() tells, not a death

  CLI::App app{"wormdrive: worm-gear drives, simulated exactly"};
  app.set_version_flag("--version", build_description());
  app.require_subcommand(1);
  const std::string typed = command_line(argc, argv);

  RunOptions run;
  CLI::App* const run_app = app.add_subcommand("run", "simulate a scenario and write an HDF5 file");
  add_scenario_options(*run_app, run.scenario);
  run_app->add_option("-o,--output", run.output, "result file; default: the scenario's name with .h5");
  run_app->add_flag("--audit", run.audit, "integrate again with another method and look for missed events");
  add_force(*run_app, run.replace);

  ScenarioOptions check;
  CLI::App* const check_app =
      app.add_subcommand("check", "show resolved parameters, what follows from them, and warnings");
  add_scenario_options(*check_app, check);

  StaticsOptions statics;
  CLI::App* const statics_app =
      app.add_subcommand("statics", "locking regime and break-in torques over the load torque");
  add_scenario_options(*statics_app, statics.scenario);
  statics_app->add_option("-o,--output", statics.output, "also write the map as HDF5");
  statics_app
      ->add_option("--max-load", statics.max_load,
                   "largest load torque [N m]; default: 1.5 times that of the arm, without one 1.5 N m")
      ->check(positive);
  statics_app->add_option("--points", statics.points, "loads from -max to +max")
      ->check(CLI::Range(3, 100000))
      ->capture_default_str();
  add_force(*statics_app, statics.replace);

  SteadyOptions steady;
  CLI::App* const steady_app = app.add_subcommand("steady", "motor torque needed to run at constant speed");
  add_scenario_options(*steady_app, steady.scenario);
  steady_app->add_option("-o,--output", steady.output, "also write curve and records as HDF5");
  steady_app->add_option("--data", steady.data,
                         "CSV: record, worm_speed_rad_per_s, motor_torque_Nm; compared with the model");
  steady_app
      ->add_option("--max-speed", steady.max_speed, "largest worm speed [rad/s]; default: that of the data, else 100")
      ->check(positive);
  steady_app->add_option("--points", steady.points, "speeds in each direction")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  add_force(*steady_app, steady.replace);

  DiagnoseOptions diagnose;
  CLI::App* const diagnose_app =
      app.add_subcommand("diagnose", "find out what a scenario lacks to predict measured data, and extend it");
  add_scenario_options(*diagnose_app, diagnose.scenario);
  diagnose_app
      ->add_option("data", diagnose.data,
                   "recordings over time (.csv, .h5), records at constant speed or a break-in table (.csv), told apart "
                   "by their columns; several of one kind are diagnosed together")
      ->required();
  add_repeated(
      *diagnose_app, "--load", diagnose.loads, "FILE:KEY=VALUE",
      "load of one recording where it is not the scenario's, as in --load heavy.csv:mass_kg=0.9; may be repeated");
  diagnose_app->add_option("-o,--output", diagnose.output, "folder for what is found")->required();
  diagnose_app->add_option("--seed", diagnose.seed, "of the bootstraps")
      ->check(CLI::Range(0.0, 9007199254740992.0, "NOT NEGATIVE"))
      ->capture_default_str();
  diagnose_app->add_option("--threads", diagnose.threads, "default: as many as there are")->check(CLI::Range(1, 1024));
  diagnose_app->add_flag_callback(
      "--no-pictures", [&] { diagnose.pictures = false; }, "write no pictures");
  add_force(*diagnose_app, diagnose.replace);

  PlotOptions plot;
  CLI::App* const plot_app = app.add_subcommand("plot", "draw a result file as PNG");
  plot_app
      ->add_option(
          "files", plot.files,
          "result of run, statics, steady or sweep (.h5); a statics result and runs: their break-aways in its map; a "
          "sweep and runs of its trials: one over the other")
      ->required();
  plot_app
      ->add_option("--over", plot.over,
                   "draw runs over the motor torque instead of time, one or several in one picture")
      ->check(CLI::IsMember({"motor_torque"}));
  plot_app->add_option("--part", plot.part, "which picture of a diagnosis; default: prediction")
      ->check(CLI::IsMember({"prediction", "residual", "ranking", "certificate"}));
  plot_app->add_option("-o,--output", plot.output, "picture; default: the file's name with .png");
  add_force(*plot_app, plot.replace);

  SweepOptions sweep;
  CLI::App* const sweep_app =
      app.add_subcommand("sweep", "run a study: many trials of a scenario with uncertain numbers");
  sweep_app->add_option("study", sweep.study, "study (.toml)")->required();
  sweep_app->add_option("-o,--output", sweep.output, "result file; default: the study's name with .h5");
  sweep_app->add_option("--threads", sweep.threads, "default: as many as the machine has")->check(CLI::Range(1, 4096));
  sweep_app->add_option("--shard", sweep.shard, "the i-th of n parts of the trials only, for `wormdrive merge`")
      ->type_name("I/N");
  sweep_app->add_option("--max-failures", sweep.max_failures, "stop when more trials than that fail");
  sweep_app->add_option("--referee", sweep.referee,
                        "trials that cvode runs again under the recorded torque; default: as many as fit into 5 % of "
                        "the time, at least 8");
  sweep_app->add_flag("--resume", sweep.resume, "keep the trials of an interrupted sweep and make the missing ones");
  sweep_app->add_flag("-q,--quiet", sweep.quiet, "print faults only");
  add_force(*sweep_app, sweep.replace);

  MergeOptions merge;
  CLI::App* const merge_app = app.add_subcommand("merge", "put the shards of a sweep together");
  merge_app->add_option("shards", merge.shards, "all shards of one sweep (.h5), in any order")->required();
  merge_app->add_option("-o,--output", merge.output, "result file")->required();
  merge_app->add_flag("-q,--quiet", merge.quiet, "print faults only");
  add_force(*merge_app, merge.replace);

  ReplayOptions replay;
  CLI::App* const replay_app = app.add_subcommand("replay", "run one trial of a sweep again, with its trajectory");
  replay_app->add_option("sweep", replay.sweep, "result of a sweep (.h5)")->required();
  replay_app->add_option("--trial", replay.trial, "index of the trial")->required();
  replay_app->add_option("-o,--output", replay.output, "result file of the run")->required();
  replay_app->add_flag("-q,--quiet", replay.quiet, "print faults only");
  add_force(*replay_app, replay.replace);

  SummaryOptions summary;
  CLI::App* const summary_app = app.add_subcommand("summary", "what a sweep comes to: quantiles, risks, influences");
  summary_app->add_option("sweep", summary.sweep, "result of a sweep (.h5)")->required();
  summary_app->add_option("--metric", summary.metric,
                          "ranks parameters and trials; default: that of the first threshold, else one with a unit");
  summary_app->add_option("--worst", summary.worst, "how many of the worst trials are shown")->capture_default_str();
  summary_app->add_flag("--done-only", summary.done_only, "leave out refused and halted trials, else the worst");
  summary_app->add_flag("--json", summary.json, "print the result as JSON");

  WorstOptions worst;
  CLI::App* const worst_app =
      app.add_subcommand("worst", "search the uncertain numbers of a sweep for the worst drive");
  worst_app->add_option("sweep", worst.sweep, "result of a sweep (.h5)")->required();
  worst_app->add_option("-o,--output", worst.output, "result file of the worst run")->required();
  worst_app->add_option("--metric", worst.metric, "whose worst value is looked for; default: as in summary");
  worst_app->add_option("--evaluations", worst.evaluations, "runs at most")
      ->check(CLI::Range(4, 1000000))
      ->capture_default_str();
  worst_app->add_option("--tail", worst.tail, "probability that is left out at either end of each number")
      ->check(CLI::Range(1e-12, 0.49))
      ->capture_default_str();
  worst_app->add_flag("--done-only", worst.done_only, "look among drives alone that run to the end");
  worst_app->add_option("--threads", worst.threads, "default: as many as the machine has")->check(CLI::Range(1, 4096));
  worst_app->add_flag("-q,--quiet", worst.quiet, "print faults only");
  add_force(*worst_app, worst.replace);

  FmuOptions fmu;
  CLI::App* const fmu_app =
      app.add_subcommand("fmu", "write the plant of a scenario as an FMU (FMI 2.0, model exchange)");
  add_scenario_options(*fmu_app, fmu.scenario);
  fmu_app->add_option("-o,--output", fmu.output, "FMU; default: the scenario's name with .fmu");
  add_force(*fmu_app, fmu.replace);

  const HelpArguments help(app, not_negative);

  std::string what;
  CLI::App* const list_app =
      app.add_subcommand("list", "list effects, loads, torques, controllers, references or scenarios");
  list_app
      ->add_option("topic", what,
                   "effects (effects.md: as a page), loads, torques, controllers, references or scenarios")
      ->required()
      ->check(CLI::IsMember({"effects", "effects.md", "loads", "torques", "controllers", "references", "scenarios"}));

  app.footer("wormdrive COMMAND --help tells more of a command. To start: wormdrive new my_drive.toml");
  if (const auto fault = unknown_command(app, argc, argv)) {
    std::cerr << *fault << '\n';
    return bad_input;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return told(app, error);
  }
  for (ScenarioOptions* options :
       {&run.scenario, &check, &statics.scenario, &steady.scenario, &diagnose.scenario, &fmu.scenario})
    options->command_line = typed;
  sweep.command_line = merge.command_line = replay.command_line = worst.command_line = typed;
  return if_printed(guarded([&] {
    if (run_app->parsed()) return run_command(run);
    if (check_app->parsed()) return check_command(check);
    if (statics_app->parsed()) return statics_command(statics);
    if (steady_app->parsed()) return steady_command(steady);
    if (diagnose_app->parsed()) return diagnose_command(diagnose);
    if (plot_app->parsed()) return plot_command(plot);
    if (sweep_app->parsed()) return sweep_command(sweep);
    if (merge_app->parsed()) return merge_command(merge);
    if (replay_app->parsed()) return replay_command(replay);
    if (summary_app->parsed()) return summary_command(summary);
    if (worst_app->parsed()) return worst_command(worst);
    if (fmu_app->parsed()) return fmu_command(fmu);
    if (const std::optional<int> code = help.run()) return *code;
    return list_command(what);
  }));
}
