#include "cli/commands/sweep/sweep_steps.hpp"

#include <algorithm>
#include <charconv>
#include <ctime>

#include <fmt/format.h>

#include "cli/describe/drive.hpp"
#include "cli/describe/sweep.hpp"
#include "description/diagnostics.hpp"
#include "statistics/cpu_time.hpp"
#include "statistics/threads.hpp"
#include "sweep/file/pieces.hpp"
#include "sweep/referee.hpp"

namespace wormdrive {
namespace {
volatile std::sig_atomic_t interrupted = 0;
std::timespec first_signal;

/// timeout and job managers send a signal to a process and to its group: what follows at once is not a second one.
constexpr double at_once = 0.5;  // [s]

void interrupt(int signal) {
  std::timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (interrupted == 0) {
    first_signal = now;
    interrupted = signal;
    return;
  }
  const double since = static_cast<double>(now.tv_sec - first_signal.tv_sec) +
                       1e-9 * static_cast<double>(now.tv_nsec - first_signal.tv_nsec);
  if (since < at_once) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

Interruptible::Interruptible() {
  struct sigaction action {};
  action.sa_handler = interrupt;
  for (std::size_t k = 0; k < std::size(signals); ++k) sigaction(signals[k], &action, &before_[k]);
}

Interruptible::~Interruptible() {
  for (std::size_t k = 0; k < std::size(signals); ++k) sigaction(signals[k], &before_[k], nullptr);
}

int Interruptible::signal() { return interrupted; }

TrialRange range_of(const std::string& shard, std::uint64_t trials) {
  if (shard.empty()) return {0, trials};
  std::uint64_t part = 0, parts = 0;
  const char* const end = shard.data() + shard.size();
  const auto first = std::from_chars(shard.data(), end, part);
  const bool slash = first.ptr != end && *first.ptr == '/';
  const auto second = slash ? std::from_chars(first.ptr + 1, end, parts) : first;
  if (!slash || first.ec != std::errc() || second.ec != std::errc() || second.ptr != end || part < 1 || part > parts)
    reject({"--shard " + shard}, "must be i/n with 1 <= i <= n, as in 3/7");
  if (parts > trials)
    reject({"--shard " + shard}, fmt::format("the study has only {} trials; use at most as many shards", trials));
  const auto begin = [&](std::uint64_t k) { return trials / parts * k + std::min(k, trials % parts); };
  return {begin(part - 1), begin(part)};
}

std::string how_to_resume(const std::string& typed, bool resumes) {
  if (resumes) return "continue with: " + typed;
  const std::size_t end = std::min(typed.find(" -- "), typed.size());  // behind it there are no options
  return fmt::format("continue with: {} --resume{}", typed.substr(0, end), typed.substr(end));
}

EarlyEnd ended_early(const std::vector<std::string>& parts, std::uint64_t max_failures) {
  const SweepPieces pieces(parts);
  ReasonTable reasons;
  std::uint64_t trials = 0, end = 0;
  for (const auto& [range, part] : pieces.in_order)
    for_each_trial(*part, range, [&](const Trial& trial) {
      if (reasons.total() > max_failures) return;
      reasons.code(trial.reason, trial.index);
      ++trials;
      end = trial.index + 1;
    });
  return {end, too_many_failed(reasons, trials, max_failures)};
}

StoppingRule::Counts counted_in(const std::vector<std::string>& parts, const StoppingRule& rule) {
  StoppingRule::Counts counts = rule.none();
  if (counts.empty()) return counts;
  for (const std::string& path : parts) {
    const SweepReader part(path);
    for (const TrialRange& there : part.present())
      for_each_trial(part, there, [&](const Trial& trial) { rule.count(trial, counts); });
  }
  return counts;
}

bool exceeds_failures(const SweepOptions& options, const StoppingRule& rule, std::uint64_t so_far) {
  return options.max_failures && (rule.end() ? rule.failed() : so_far) > *options.max_failures;
}

void print_end(const Study& study, const StoppingRule& rule) {
  if (!study.may_end_early()) return;
  print_item("end", rule.end()
                        ? fmt::format("{} of at most {} trials are enough", *rule.end(), study.trials())
                        : fmt::format("all {} trials are not enough for what until_percent asks", study.trials()));
}

std::vector<RefereeVerdict> judge(SweepFile& file, const Study& study, const SweepOptions& options, double trials_took,
                                  const std::function<std::uint64_t()>& take) {
  constexpr double share = 0.05;
  constexpr std::uint64_t least = 8;  // trials that a referee looks at in any case
  if (study.scenario.run.solver == SolverKind::cvode) return {};
  file.flush();
  const double begin = cpu_time();
  const auto enough = [&] {
    if (Interruptible::signal() != 0) return true;
    const std::uint64_t before = take();
    return options.referee ? before >= *options.referee : before >= least && cpu_time() - begin >= share * trials_took;
  };
  std::vector<RefereeVerdict> verdicts = referee(SweepReader(file.part_path()), threads_for(options.threads), enough);
  file.write(verdicts);
  return verdicts;
}

}  // namespace wormdrive
