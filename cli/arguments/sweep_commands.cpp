#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"

namespace wormdrive {
namespace {

void add_sweep(CommandSet& commands) {
  auto [command, options] =
      commands.add("sweep", "run the trials of a study, each with its own parameters", sweep_command);
  command.add_option("study", options.study, "study (.toml)")->required();
  command.add_option("-o,--output", options.output, "result file; default: the study's name with .h5");
  add_threads(command, options.threads);
  command.add_option("--shard", options.shard, "run only part I of N; wormdrive merge combines the parts")
      ->type_name("I/N");
  command.add_option("--max-failures", options.max_failures, "stop when more trials than this have failed");
  command.add_option("--referee", options.referee,
                     "number of trials that cvode repeats under the recorded torque; default: as many as fit into 5 % "
                     "of the time, at least 8");
  command.add_flag("--resume", options.resume, "continue an interrupted sweep: run only the missing trials");
  add_quiet(command, options.quiet);
  add_force(command, options.replace);
}

void add_summary(CommandSet& commands) {
  auto [command, options] =
      commands.add("summary", "print what a sweep shows: limits missed, quantiles, influences", summary_command);
  command.add_option("sweep", options.sweep, "result of a sweep (.h5)")->required();
  command.add_option("--metric", options.metric,
                     "metric that ranks parameters and trials; default: that of the first threshold, or the first one "
                     "with a unit");
  command.add_option("--worst", options.worst, "number of worst trials to list")->capture_default_str();
  command.add_flag("--done-only", options.done_only,
                   "leave out refused and halted trials, which otherwise count as the worst");
  add_json(command, options.json);
}

void add_worst(CommandSet& commands) {
  auto [command, options] =
      commands.add("worst", "search the uncertain parameters of a sweep for the worst drive", worst_command);
  command.add_option("sweep", options.sweep, "result of a sweep (.h5)")->required();
  command.add_option("-o,--output", options.output, "result file of the worst run")->required();
  command.add_option("--metric", options.metric, "metric whose worst value is sought; default: as in summary");
  command.add_option("--evaluations", options.evaluations, "largest number of runs")
      ->check(CLI::Range(4, 1000000))
      ->capture_default_str();
  command.add_option("--tail", options.tail, "probability left out at either end of each parameter")
      ->check(CLI::Range(1e-12, 0.49))
      ->capture_default_str();
  command.add_flag("--done-only", options.done_only, "search only among drives that run to the end");
  add_threads(command, options.threads);
  add_quiet(command, options.quiet);
  add_force(command, options.replace);
}

void add_rare(CommandSet& commands) {
  auto [command, options] =
      commands.add("rare", "estimate how rarely the drives of a study miss a limit, down to 1e-9", rare_command);
  command.add_option("study", options.study, "study (.toml); its design does not matter")->required();
  command.add_option("--metric", options.metric, "metric of the limit; default: that of the first [[threshold]]");
  command.add_option("--per-level", options.per_level, "runs of each level of the subset simulation")
      ->check(CLI::Range(100, 1000000))
      ->capture_default_str();
  command.add_option("--samples", options.samples, "runs around the design point")
      ->check(CLI::Range(100, 10000000))
      ->capture_default_str();
  command.add_option("-o,--output", options.output, "result file; without it nothing is kept");
  command.add_flag("--resume", options.resume, "continue an interrupted estimate: only the missing runs are made");
  add_force(command, options.replace);
  add_threads(command, options.threads);
  add_json(command, options.json);
}

void add_replay(CommandSet& commands) {
  auto [command, options] =
      commands.add("replay", "run one trial of a sweep again and write its trajectory", replay_command);
  command.add_option("sweep", options.sweep, "result of a sweep (.h5)")->required();
  command.add_option("--trial", options.trial, "index of the trial, counted from 0")->required();
  command.add_option("-o,--output", options.output, "result file of the run")->required();
  add_quiet(command, options.quiet);
  add_force(command, options.replace);
}

void add_merge(CommandSet& commands) {
  auto [command, options] = commands.add("merge", "combine the shards of a sweep into one result", merge_command);
  command.add_option("shards", options.shards, "all shards of one sweep (.h5), in any order")->required();
  command.add_option("-o,--output", options.output, "result file")->required();
  add_quiet(command, options.quiet);
  add_force(command, options.replace);
}

}  // namespace

void add_sweep_commands(CommandSet& commands) {
  commands.begin_group("Vary uncertain parameters");
  add_sweep(commands);
  add_summary(commands);
  add_worst(commands);
  add_rare(commands);
  add_replay(commands);
  add_merge(commands);
}

}  // namespace wormdrive
