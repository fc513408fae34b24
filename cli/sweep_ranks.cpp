#include "cli/sweep_ranks.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/describe.hpp"
#include "cli/describe_sweep.hpp"
#include "cli/progress.hpp"
#include "cli/replay_trial.hpp"
#include "cli/shell_words.hpp"
#include "cli/sweep_steps.hpp"
#include "events/halt.hpp"
#include "sweep/merge.hpp"
#include "sweep/rank_files.hpp"
#include "sweep/threads.hpp"

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

/// What a rank does of a sweep.
class RankSweep {
 public:
  RankSweep(Ranks& ranks, const SweepOptions& options, const Study& study, const std::string& path, Missing missing)
      : ranks_(ranks),
        options_(options),
        study_(study),
        path_(path),
        missing_(std::move(missing)),
        portion_(
            std::clamp<std::uint64_t>(missing_.count() / (64 * static_cast<std::uint64_t>(ranks.count())), 1, 256)) {}

  void make() {
    const TrialRange all{0, study_.trials()};
    SweepFile::create(path_, study_, all, options_.command_line);
    SweepFile file(path_, study_, all);
    Progress progress(static_cast<double>(missing_.count()), options_.quiet || !ranks_.first());
    const double begin = cpu_time();
    const auto take = [&](const Trial& trial) {
      file.append(trial);
      ++made_;
      if (trial.status != TrialStatus::done) ranks_.add(Ranks::Counter::failures, 1);
      progress.at(static_cast<double>(std::min(reached_.load(), missing_.count())), [&](double seconds) {
        return fmt::format(", about {:.0f} trials/s on {} ranks", static_cast<double>(reached_.load()) / seconds,
                           ranks_.count());
      });
      return true;
    };
    run_ensemble(
        study_, [this] { return next(); }, threads_for(options_.threads), take,
        [] { return Interruptible::signal() != 0; });
    const auto ranks = static_cast<std::size_t>(ranks_.count());
    if (!too_many() && Interruptible::signal() == 0)
      judge(file, study_, options_, cpu_time() - begin, (least_judged + ranks - 1) / ranks);
    file.flush();
  }
  std::uint64_t made() const { return made_; }
  /// What was taken by then is made nevertheless, so that every trial before the last one is there.
  bool too_many() { return ranks_.add(Ranks::Counter::failures, 0) > options_.max_failures.value_or(never); }

 private:
  static constexpr std::uint64_t never = ~std::uint64_t{0};

  /// The next trials that no rank has taken.
  std::optional<TrialRange> next() {
    if (left_ == 0) {
      if (too_many()) return std::nullopt;
      at_ = ranks_.add(Ranks::Counter::portion, 1) * portion_;
      left_ = at_ < missing_.count() ? std::min(portion_, missing_.count() - at_) : 0;
      reached_ = at_;
    }
    if (left_ == 0) return std::nullopt;
    const TrialRange range = missing_.at(at_, left_);
    at_ += range.size();
    left_ -= range.size();
    return range;
  }

  Ranks& ranks_;
  const SweepOptions& options_;
  const Study& study_;
  std::string path_;
  Missing missing_;
  std::uint64_t portion_, at_ = 0, left_ = 0;
  std::atomic<std::uint64_t> reached_{0};
  std::uint64_t made_ = 0;
};

/// What the first rank finds of earlier ones, for all of them; nothing for the others if it has a fault to tell.
std::optional<RankPlan> agreed(Ranks& ranks, const SweepOptions& options, const Study& study,
                               const std::string& output) {
  RankPlan plan;
  std::vector<std::uint64_t> told{2};  // that something is wrong
  if (ranks.first()) {
    try {
      plan = plan_ranks(output, study, options.resume);
      ranks.add(Ranks::Counter::failures, plan.failed);
    } catch (...) {
      ranks.told(told);
      throw;
    }
    told = {plan.complete ? std::uint64_t{1} : 0, plan.generation};
    for (const TrialRange& range : plan.missing) told.insert(told.end(), {range.first, range.end});
  }
  told = ranks.told(std::move(told));
  if (told.front() == 2) return std::nullopt;
  plan = {told[0] == 1, told[1], 0, {}};
  for (std::size_t k = 2; k < told.size(); k += 2) plan.missing.push_back({told[k], told[k + 1]});
  return plan;
}

/// What a single process would say that ends with the trial that is one failure too many.
std::string why_ended(const std::string& output, std::uint64_t max_failures) {
  std::vector<std::unique_ptr<SweepReader>> parts;
  std::vector<std::pair<TrialRange, const SweepReader*>> ranges;
  for (const std::string& part : rank_parts(output)) {
    parts.push_back(std::make_unique<SweepReader>(part));
    for (const TrialRange& range : parts.back()->present()) ranges.emplace_back(range, parts.back().get());
  }
  std::sort(ranges.begin(), ranges.end(), [](const auto& a, const auto& b) { return a.first.first < b.first.first; });
  ReasonTable reasons;
  std::uint64_t trials = 0;
  for (const auto& [range, part] : ranges)
    for_each_trial(*part, range, [&](const Trial& trial) {
      if (reasons.total() > max_failures) return;
      reasons.code(trial.reason);
      ++trials;
    });
  return too_many_failed(reasons, trials, max_failures);
}

/// Puts together what the ranks have made; the first one does it.
void join(const SweepOptions& options, const std::string& output) {
  const std::vector<std::string> parts = rank_parts(output);
  std::vector<std::string> used;
  for (const std::string& part : parts)
    if (SweepReader(part).trials() > 0) used.push_back(part);
  merge_shards(used, output, options.command_line);
  for (const std::string& part : parts) std::filesystem::remove(part);
}

}  // namespace

int sweep_on_ranks(Ranks& ranks, const SweepOptions& options, const Study& study, const std::string& output) {
  const std::optional<RankPlan> agreement = agreed(ranks, options, study, output);
  if (!agreement) return 2;
  const RankPlan& plan = *agreement;
  const bool talks = ranks.first() && !options.quiet;
  if (talks) print_study(study, {0, study.trials()});
  if (plan.complete) {
    if (talks) print_item("resume", fmt::format("every trial is in {} already", output));
    return 0;
  }
  const Missing missing(plan.missing);
  const auto begin = std::chrono::steady_clock::now();
  RankSweep sweep(ranks, options, study, rank_file(output, plan.generation, ranks.rank()), missing);
  std::string fault;
  try {
    sweep.make();
  } catch (const OutputFault& what) {  // the others go on: they must not wait for this one
    fault = what.what();
    fmt::print(stderr, "wormdrive: rank {}: {}\n", ranks.rank(), fault);
  }
  const std::uint64_t made = ranks.sum(sweep.made());
  const bool broken = ranks.sum(fault.empty() ? 0 : 1) > 0, too_many = sweep.too_many();
  const std::uint64_t there = study.trials() - missing.count() + made;
  const std::string resume = fmt::format("go on with: mpirun -n {} {}", ranks.count(),
                                         how_to_resume(options).substr(std::string("go on with: ").size()));
  if (broken || too_many || made < missing.count()) {
    if (ranks.first() && too_many)
      fmt::print(stderr, "wormdrive: {}; {}.rank_* keep them all\n", why_ended(output, *options.max_failures), output);
    else if (ranks.first())
      fmt::print(stderr, "wormdrive: ended after {} of {} trials, all of them in {}.rank_*; {}\n", there,
                 study.trials(), output, resume);
    return too_many ? 3 : broken ? 4 : 128 + Interruptible::signal();
  }
  if (ranks.first()) {
    join(options, output);
    keep_trajectories(output, options.command_line, options.quiet);
  }
  if (!talks) return 0;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  print_item("run", fmt::format("{} trials in {:.3g} s on {} rank{}, {:.0f} a second{}", made, seconds, ranks.count(),
                                ranks.count() == 1 ? "" : "s", static_cast<double>(made) / seconds,
                                there > made ? fmt::format("; {} were there already", there - made) : ""));
  const SweepReader result(output);
  print_failures(result.counted_reasons());
  print_verdicts(result.verdicts(), study.referee_tolerance);
  print_item("wrote", fmt::format("{}    see it: wormdrive summary {}", output, shell_path(output)));
  return 0;
}

}  // namespace wormdrive
