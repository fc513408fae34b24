#include "cli/commands/sweep/sweep_ranks.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "cli/commands/sweep/sweep_steps.hpp"
#include "cli/describe/drive.hpp"
#include "cli/describe/sweep.hpp"
#include "cli/exit_code.hpp"
#include "cli/progress.hpp"
#include "cli/replay_trial.hpp"
#include "cli/shell_words.hpp"
#include "events/simulation_failure.hpp"
#include "statistics/cpu_time.hpp"
#include "statistics/threads.hpp"
#include "sweep/file/merge.hpp"
#include "sweep/ranks/rank_files.hpp"

namespace wormdrive {
namespace {

/// The k-th of all trials that are missing, and those behind it, as far as one range goes.
class Missing {
 public:
  explicit Missing(std::vector<TrialRange> ranges) : ranges_(std::move(ranges)), count_(trials_in(ranges_)) {}

  std::uint64_t count() const { return count_; }
  /// Takes from the k-th on at most so many.
  TrialRange at(std::uint64_t k, std::uint64_t most) const {
    for (const TrialRange& range : ranges_) {
      if (k < range.size()) return {range.first + k, std::min(range.end, range.first + k + most)};
      k -= range.size();
    }
    return {};
  }

 private:
  std::vector<TrialRange> ranges_;
  std::uint64_t count_;
};

/// What ranks tell each other of the trials that they have made.
struct Counted {
  std::uint64_t failures;
  StoppingRule::Counts counts;
};

/// Of what ranks share, how much one takes: portions of trials, and trials for the referee.
struct Taken {
  std::uint64_t portions = 0, judged = 0;
};
/// Adds to what all ranks have counted, and turns it into what all have counted then. Returns what was taken before.
Taken add_to(Ranks& ranks, Taken more, Counted& counted) {
  Tally told{more.portions, more.judged, counted.failures};
  told.insert(told.end(), counted.counts.begin(), counted.counts.end());
  const Tally before = ranks.add(std::move(told));
  counted.failures += before[2];
  add(counted.counts, std::span(before).subspan(3));
  return {before[0], before[1]};
}

/// What a rank does of a sweep.
class RankSweep {
 public:
  RankSweep(Ranks& ranks, const SweepOptions& options, const Study& study, const std::string& path, Missing missing)
      : ranks_(ranks),
        options_(options),
        study_(study),
        path_(path),
        missing_(std::move(missing)),
        portion_(std::clamp<std::uint64_t>(missing_.count() / (64 * static_cast<std::uint64_t>(ranks.count())), 1,
                                           256 * std::uint64_t{threads_for(options.threads)})),
        rule_(study),
        untold_{0, rule_.none()} {}

  void make() {
    const TrialRange all{0, study_.trials()};
    SweepFile::create(path_, study_, all, options_.command_line);
    SweepFile file(path_, study_, all);
    Progress progress(static_cast<double>(missing_.count()), options_.quiet || !ranks_.first());
    const double begin = cpu_time();
    const auto take = [&](Trial trial) {
      {
        const std::lock_guard lock(counting_);
        untold_.failures += trial.status != TrialStatus::done;
        rule_.count(trial, untold_.counts);
      }
      file.append(std::move(trial));
      ++made_;
      progress.at(static_cast<double>(std::min(reached_.load(), missing_.count())), [&](double seconds) {
        return fmt::format(", about {:.0f} trials/s on {} ranks", static_cast<double>(reached_.load()) / seconds,
                           ranks_.count());
      });
    };
    run_ensemble(
        study_, [this] { return next(); }, threads_for(options_.threads), take, [&] { return is_to_end(file); });
    tell();
    if (!too_many() && Interruptible::signal() == 0)
      judge(file, study_, options_, cpu_time() - begin, [this] { return add({.judged = 1}).judged; });
    file.flush();
  }
  std::uint64_t made() const { return made_; }
  /// Tells the others what was counted here, and hears what they have.
  void tell() { add({}); }
  /// Whether more have failed than may, as far as is known here. What was taken by then is made nevertheless, so that
  /// every trial before the last one is there.
  bool too_many() const { return exceeds_failures(options_, rule_, failures_); }
  const StoppingRule& rule() const { return rule_; }

 private:
  /// Tells the others what was counted here, hears what they have, and takes so much; returns what was taken before.
  Taken add(Taken more) {
    Counted mine{0, rule_.none()};
    {
      const std::lock_guard lock(counting_);
      std::swap(mine, untold_);
    }
    Counted all = mine;
    const Taken before = add_to(ranks_, more, all);
    failures_ = all.failures;
    const std::lock_guard lock(counting_);
    rule_.look(all.counts);
    ends_ = rule_.end().has_value();
    return before;
  }

  /// The next trials that no rank has taken. What is counted is told with the question, so that it costs no other.
  std::optional<TrialRange> next() {
    if (left_ == 0) {
      at_ = add({.portions = 1}).portions * portion_;
      if (too_many() || ends_) return std::nullopt;
      left_ = at_ < missing_.count() ? std::min(portion_, missing_.count() - at_) : 0;
      reached_ = at_;
    }
    if (left_ == 0) return std::nullopt;
    const TrialRange range = missing_.at(at_, left_);
    at_ += range.size();
    left_ -= range.size();
    return range;
  }

  bool is_to_end(SweepFile& file) const {
    const bool interrupted = Interruptible::signal() != 0;
    if (interrupted)
      file.flush();  // trials that have begun may take longer than whoever has sent the signal waits
    else
      file.keep_safe();
    return interrupted || ends_;
  }

  Ranks& ranks_;
  const SweepOptions& options_;
  const Study& study_;
  std::string path_;
  Missing missing_;
  std::uint64_t portion_, at_ = 0, left_ = 0;
  std::atomic<std::uint64_t> reached_{0};
  StoppingRule rule_;
  Counted untold_;  ///< of trials that were made here
  std::mutex counting_;
  std::uint64_t failures_ = 0;  ///< of all ranks, when they were last told of here
  std::atomic<bool> ends_{false};
  std::uint64_t made_ = 0;
};

/// What the first rank finds of earlier ones, for all of them; nothing if it has a fault to tell, whose exit code is
/// code.
std::optional<RankPlan> agreed(Ranks& ranks, const SweepOptions& options, const Study& study, const std::string& output,
                               OutputLock& lock, int& code) {
  std::vector<std::uint64_t> told;
  code = code_of_all(ranks, [&] {
    lock = OutputLock(output);
    RankPlan plan = plan_ranks(output, study, options.resume, options.replace);
    const StoppingRule rule(study);
    Counted present{plan.failed, counted_in(rank_parts(output), rule)};
    add_to(ranks, {}, present);
    told = {plan.complete ? std::uint64_t{1} : 0, plan.generation};
    for (const TrialRange& range : plan.missing) told.insert(told.end(), {range.first, range.end});
    return 0;
  });
  if (code != 0) return std::nullopt;
  told = ranks.told(std::move(told));
  RankPlan plan{told[0] == 1, told[1], 0, {}};
  for (std::size_t k = 2; k < told.size(); k += 2) plan.missing.push_back({told[k], told[k + 1]});
  return plan;
}

/// The exit code of all ranks out of those of each.
int common_code(const Ranks& ranks, int code) {
  for (const int one : {bad_input, cannot_write, cannot_go_on})
    if (ranks.sum(code == one ? 1 : 0) > 0) return one;
  return 0;
}

/// Puts together what the ranks have made; the first one does it.
void join(const SweepOptions& options, const std::string& output, OutputLock lock, std::optional<std::uint64_t> end) {
  const std::vector<std::string> parts = rank_parts(output);
  std::vector<std::string> used;
  for (const std::string& part : parts)
    if (SweepReader(part).trials() > 0) used.push_back(part);
  merge_shards(used, output, std::move(lock), options.command_line, options.replace, end);
  for (const std::string& part : parts) std::filesystem::remove(part);
}

/// ", 317 to 323 each", how many trials each rank has made this time; nothing for a single one.
std::string shares(const std::string& output, std::uint64_t generation, int ranks) {
  if (ranks == 1) return "";
  std::uint64_t least = ~std::uint64_t{0}, most = 0;
  for (int rank = 0; rank < ranks; ++rank) {
    const std::uint64_t made = SweepReader(rank_file(output, generation, rank) + ".part").trials();
    least = std::min(least, made);
    most = std::max(most, made);
  }
  return least == most ? fmt::format(", {} each", least) : fmt::format(", {} to {} each", least, most);
}

}  // namespace

int code_of_all(Ranks& ranks, const std::function<int()>& command) {
  const int code = ranks.first() ? guarded(command) : 0;
  return static_cast<int>(ranks.told({static_cast<std::uint64_t>(code)}).front());
}

int sweep_on_ranks(Ranks& ranks, const SweepOptions& options, const Study& study, const std::string& output) {
  OutputLock lock;  // the first one holds it for all
  int code = 0;
  const std::optional<RankPlan> agreement = agreed(ranks, options, study, output, lock, code);
  if (!agreement) return code;
  const RankPlan& plan = *agreement;
  const bool talks = ranks.first() && !options.quiet;
  if (talks) print_study(study, {0, study.trials()});
  if (plan.complete) {
    if (talks) print_item("resume", fmt::format("{} already contains every trial", output));
    return 0;
  }
  const Missing missing(plan.missing);
  const auto begin = std::chrono::steady_clock::now();
  RankSweep sweep(ranks, options, study, rank_file(output, plan.generation, ranks.rank()), missing);
  const auto make = [&] {
    sweep.make();
    return 0;
  };
  // the others go on: they must not wait for this one
  const int fault = common_code(ranks, guarded(make, fmt::format("wormdrive: rank {}", ranks.rank())));
  const std::uint64_t made = ranks.sum(sweep.made());
  sweep.tell();  // by now nobody has anything left to tell: all hear the same
  const bool too_many = sweep.too_many();
  const std::optional<std::uint64_t> end = sweep.rule().end();
  if (fault == bad_input) return fault;  // going on would meet it again
  const std::uint64_t there = study.trials() - missing.count() + made;
  const std::string resume =
      fmt::format("continue with: mpirun -n {} {}", ranks.count(),
                  how_to_resume(options.command_line, options.resume).substr(std::string("continue with: ").size()));
  if (fault != 0 || too_many || (made < missing.count() && !end)) {
    if (ranks.first() && too_many)
      fmt::print(stderr, "wormdrive: {}; {}.rank_* contain all of them\n",
                 ended_early(rank_parts(output), *options.max_failures).told, output);
    else if (ranks.first() && there > 0)
      fmt::print(stderr, "wormdrive: stopped after {} of {} trials, which are in {}.rank_*; {}\n", there,
                 study.trials(), output, resume);
    return too_many ? cannot_go_on : fault != 0 ? fault : 128 + Interruptible::signal();
  }
  std::string each;
  if (ranks.first()) {
    each = shares(output, plan.generation, ranks.count());
    join(options, output, std::move(lock), end);
    keep_trajectories(output, options.command_line, options.quiet, options.replace);
  }
  if (!talks) return 0;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  print_item("run", fmt::format("{} trials in {:.3g} s on {} rank{}{}, {:.0f} per second{}", made, seconds,
                                ranks.count(), ranks.count() == 1 ? "" : "s", each, static_cast<double>(made) / seconds,
                                there > made ? fmt::format("; {} were already complete", there - made) : ""));
  print_end(study, sweep.rule());
  const SweepReader result(output);
  print_failures(result.counted_reasons());
  print_verdicts(result.verdicts(), study);
  print_item("wrote", fmt::format("{}    see it: wormdrive summary {}", output, shell_path(output)));
  return 0;
}

}  // namespace wormdrive
