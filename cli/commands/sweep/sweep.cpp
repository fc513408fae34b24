#include "cli/describe/sweep.hpp"

#include <chrono>
#include <optional>

#include <fmt/format.h>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/commands/sweep/sweep_ranks.hpp"
#include "cli/commands/sweep/sweep_steps.hpp"
#include "cli/describe/drive.hpp"
#include "cli/exit_code.hpp"
#include "cli/progress.hpp"
#include "cli/replay_trial.hpp"
#include "cli/shell_words.hpp"
#include "description/diagnostics.hpp"
#include "events/simulation_failure.hpp"
#include "statistics/cpu_time.hpp"
#include "statistics/threads.hpp"
#include "sweep/file/resume.hpp"
#include "sweep/ranks/rank_files.hpp"
#include "sweep/stopping_rule.hpp"
#include "sweep/study/load_study.hpp"

namespace wormdrive {

namespace {

void print_cost(const SweepCost& cost) {
  const double all = cost.trials + cost.file + cost.referee + cost.summary;
  const auto share = [&](double part) { return 100.0 * part / all; };
  print_item("cost",
             fmt::format("{:.3g} s of CPU time: trials {:.1f} %, file {:.1f} %, referee {:.1f} %, summary {:.1f} %",
                         all, share(cost.trials), share(cost.file), share(cost.referee), share(cost.summary)));
}

int sweep_alone(const SweepOptions& options, const Study& study, const std::string& output) {
  const TrialRange range = range_of(options.shard, study.trials());
  const OpenSweep open =
      open_sweep(output, OutputLock(output), study, range, options.command_line, options.resume, options.replace);
  if (!options.quiet) print_study(study, range);
  if (!open.file) {
    if (!options.quiet) print_item("resume", fmt::format("{} already contains every trial", output));
    return 0;
  }
  SweepFile& file = *open.file;

  const unsigned threads = threads_for(options.threads);
  const std::uint64_t wanted = trials_in(open.missing), before = range.size() - wanted;
  std::uint64_t made = 0, failed = open.failed;
  StoppingRule rule(study);
  StoppingRule::Counts counts = counted_in({file.part_path()}, rule);
  rule.look(counts);
  const auto too_many = [&] { return exceeds_failures(options, rule, failed); };
  const auto has_all = [&] { return made == wanted || rule.end(); };
  std::vector<RefereeVerdict> verdicts;
  double seconds = 0.0;
  SweepCost cost;
  const auto begin = std::chrono::steady_clock::now();
  const double cpu_begin = cpu_time(), file_begin = thread_cpu_time();
  try {
    Progress progress(static_cast<double>(wanted), options.quiet);
    auto next = open.missing.begin();
    const auto source = [&] { return next == open.missing.end() ? std::nullopt : std::optional(*next++); };
    const auto take = [&](Trial trial) {
      failed += trial.status != TrialStatus::done;
      rule.take(trial, counts);
      file.append(std::move(trial));
      progress.at(static_cast<double>(++made), [&](double passed) {
        return fmt::format(", {:.0f} trials/s, {} failed", static_cast<double>(made) / passed, failed);
      });
    };
    const auto is_to_end = [&] {
      const bool interrupted = Interruptible::signal() != 0;
      if (interrupted)
        file.flush();  // trials that have begun may take longer than whoever has sent the signal waits
      else
        file.keep_safe();
      return interrupted || too_many() || rule.end();
    };
    if (!too_many() && !rule.end()) run_ensemble(study, source, threads, take, is_to_end);
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    cost.file = thread_cpu_time() - file_begin;  // this thread has done nothing else
    cost.trials = cpu_time() - cpu_begin - cost.file;
    if (has_all() && !too_many()) {
      if (rule.end()) file.end_before(*rule.end());
      const double judge_begin = cpu_time();
      verdicts = judge(file, study, options, cost.trials, [count = std::uint64_t{0}]() mutable { return count++; });
      cost.referee = cpu_time() - judge_begin;
      file.finish();
      cost.summary = cpu_time() - judge_begin - cost.referee;
    } else {
      file.flush();
    }
  } catch (const ReadFault&) {  // which room on the disk would not mend
    throw;
  } catch (const OutputFault& fault) {
    throw OutputFault(fmt::format("{}; trials older than a second are safe; free some space, then {}", fault.what(),
                                  how_to_resume(options.command_line, options.resume)));
  }
  if (too_many()) {  // threads were ahead of the trial that was one too many
    const EarlyEnd early = ended_early({file.part_path()}, *options.max_failures);
    file.drop_from(early.end);
    throw SimulationFailure(fmt::format("{}; {} contains all of them", early.told, file.part_path()));
  }
  if (!has_all()) {
    fmt::print(stderr, "wormdrive: interrupted after {} of {} trials, which are in {}; {}\n", before + made,
               range.size(), file.part_path(), how_to_resume(options.command_line, options.resume));
    return 128 + Interruptible::signal();
  }
  keep_trajectories(output, options.command_line, options.quiet, options.replace);
  if (options.quiet) return 0;
  print_item("run", fmt::format("{} trials in {:.3g} s on {} thread{}, {:.0f} per second{}", made, seconds, threads,
                                threads == 1 ? "" : "s", static_cast<double>(made) / seconds,
                                before > 0 ? fmt::format("; {} were already complete", before) : ""));
  print_end(study, rule);
  print_cost(cost);
  print_failures(SweepReader(output).counted_reasons());
  print_verdicts(verdicts, study);
  print_item("wrote", fmt::format("{}    see it: wormdrive summary {}", output, shell_path(output)));
  return 0;
}

int sweep_together(Ranks& ranks, const SweepOptions& options) {
  const std::string output = followed(options.output.empty() ? default_output(options.study, ".h5") : options.output);
  std::optional<Study> read;
  const auto look = [&] {
    read = load_study(options.study);
    for (const std::string& input : {options.study, read->scenario_file}) reject_overwriting(output, input);
    if (ranks.count() > 1 && !options.shard.empty())
      reject({"--shard " + options.shard}, "the ranks share all trials; remove the option");
    if (read->may_end_early() && !options.shard.empty())
      reject({options.study},
             "threshold.until_percent ends a sweep whose processes count together; remove it, or run without --shard");
    return 0;
  };
  // what is wrong is told by the first rank alone: it looks at everything before the others do
  if (const int code = code_of_all(ranks, look)) return code;
  const Study study = read ? std::move(*read) : load_study(options.study);  // once: it may be a pipe
  const Interruptible interruptible;
  if (ranks.count() > 1 || !rank_parts(output).empty()) return sweep_on_ranks(ranks, options, study, output);
  return sweep_alone(options, study, output);
}

int sweep_command(const SweepOptions& options) {
  std::optional<Ranks> ranks;
  return guarded([&] {  // mpirun may lose what is said behind the ranks' common end
    ranks.emplace(!options.shard.empty());
    return sweep_together(*ranks, options);
  });
}

}  // namespace

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

}  // namespace wormdrive
