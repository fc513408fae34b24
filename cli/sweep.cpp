#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <csignal>
#include <thread>

#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/describe.hpp"
#include "cli/describe_sweep.hpp"
#include "cli/progress.hpp"
#include "events/halt.hpp"
#include "scenarios/faults.hpp"
#include "sweep/ensemble.hpp"
#include "sweep/load_study.hpp"
#include "sweep/resume.hpp"

namespace wormdrive {
namespace {

volatile std::sig_atomic_t interrupted = 0;

/// While it lives, SIGINT and SIGTERM ask for an end instead of being one; a second one ends at once.
class Interruptible {
 public:
  Interruptible() {
    struct sigaction action {};
    action.sa_handler = [](int signal) { interrupted = signal; };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    for (std::size_t k = 0; k < std::size(signals); ++k) sigaction(signals[k], &action, &before_[k]);
  }
  Interruptible(const Interruptible&) = delete;
  ~Interruptible() {
    for (std::size_t k = 0; k < std::size(signals); ++k) sigaction(signals[k], &before_[k], nullptr);
  }

 private:
  static constexpr int signals[] = {SIGINT, SIGTERM};
  struct sigaction before_[2]{};
};

/// "3/7" as the third of seven parts of all trials, as even as whole trials allow.
TrialRange range_of(const std::string& shard, std::uint64_t trials) {
  if (shard.empty()) return {0, trials};
  std::uint64_t part = 0, parts = 0;
  const char* const end = shard.data() + shard.size();
  const auto first = std::from_chars(shard.data(), end, part);
  const bool slash = first.ptr != end && *first.ptr == '/';
  const auto second = slash ? std::from_chars(first.ptr + 1, end, parts) : first;
  if (!slash || first.ec != std::errc() || second.ec != std::errc() || second.ptr != end || part < 1 || part > parts)
    refuse({"--shard " + shard}, "must be i/n with 1 <= i <= n, as in 3/7");
  if (parts > trials)
    refuse({"--shard " + shard}, fmt::format("the study has only {} trials; take at most as many shards", trials));
  const auto begin = [&](std::uint64_t k) { return trials / parts * k + std::min(k, trials % parts); };
  return {begin(part - 1), begin(part)};
}

std::string how_to_resume(const SweepOptions& options) {
  const bool has = options.command_line.find(" --resume") != std::string::npos;
  return fmt::format("go on with: {}{}", options.command_line, has ? "" : " --resume");
}

}  // namespace

int sweep_command(const SweepOptions& options) {
  const Study study = load_study(options.study);
  const TrialRange range = range_of(options.shard, study.trials());
  const std::string output = options.output.empty() ? default_output(options.study, ".h5") : options.output;
  refuse_to_overwrite(output, options.study);
  const Interruptible interruptible;
  const OpenSweep open = open_sweep(output, study, range, options.command_line, options.resume);
  if (!options.quiet) print_study(study, range);
  if (!open.file) {
    if (!options.quiet) print_item("resume", fmt::format("every trial is in {} already", output));
    return 0;
  }
  SweepFile& file = *open.file;

  const unsigned threads = options.threads > 0 ? options.threads : std::max(1U, std::thread::hardware_concurrency());
  const std::uint64_t wanted = trials_in(open.missing), before = range.size() - wanted;
  std::uint64_t made = 0;
  const auto too_many = [&] { return options.max_failures && file.reasons().total() > *options.max_failures; };
  const auto begin = std::chrono::steady_clock::now();
  try {
    Progress progress(static_cast<double>(wanted), options.quiet);
    auto next = open.missing.begin();
    const auto source = [&] { return next == open.missing.end() ? std::nullopt : std::optional(*next++); };
    const auto take = [&](const Trial& trial) {
      file.append(trial);
      progress.at(static_cast<double>(++made), [&](double seconds) {
        return fmt::format(", {:.0f} trials/s, {} failed", static_cast<double>(made) / seconds, file.reasons().total());
      });
      return !too_many();
    };
    if (!too_many()) run_ensemble(study, source, threads, take, [] { return interrupted != 0; });
    if (made == wanted && !too_many())
      file.finish();
    else
      file.flush();
  } catch (const OutputFault& fault) {
    throw OutputFault(fmt::format("{}; nothing before the last second is lost: make room, then {}", fault.what(),
                                  how_to_resume(options)));
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (too_many())
    throw Halt(fmt::format("{} of {} trials failed, more than --max-failures {}; most often: {}; {} keeps them all",
                           file.reasons().total(), before + made, *options.max_failures, most_frequent(file.reasons()),
                           file.part_path()));
  if (made < wanted) {
    fmt::print(stderr, "wormdrive: interrupted after {} of {} trials, all of them in {}; {}\n", before + made,
               range.size(), file.part_path(), how_to_resume(options));
    return 128 + interrupted;
  }
  if (options.quiet) return 0;
  print_item("run", fmt::format("{} trials in {:.3g} s on {} thread{}, {:.0f} a second{}", made, seconds, threads,
                                threads == 1 ? "" : "s", static_cast<double>(made) / seconds,
                                before > 0 ? fmt::format("; {} were there already", before) : ""));
  print_failures(file.reasons());
  print_item("wrote", fmt::format("{}    see it: wormdrive summary {}", output, output));
  return 0;
}

}  // namespace wormdrive
