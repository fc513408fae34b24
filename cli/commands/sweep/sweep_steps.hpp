#pragma once
#include <csignal>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "output/replacing.hpp"
#include "sweep/ensemble.hpp"
#include "sweep/file/sweep_file.hpp"
#include "sweep/stopping_rule.hpp"

namespace wormdrive {

struct SweepOptions {
  std::string study;
  std::string output;    ///< empty: named after the study
  unsigned threads = 0;  ///< 0: as many as the machine has
  std::string shard;     ///< "i/n"; empty: all trials
  std::optional<std::uint64_t> max_failures;
  std::optional<std::uint64_t> referee;  ///< trials that CVODE judges; else what fits into 5 % of the time
  bool resume = false;
  bool quiet = false;
  Replace replace = Replace::same_kind;
  std::string command_line;
};

/// While it lives, SIGINT, SIGTERM and SIGUSR1 ask for an end instead of being one; a second one, half a second later,
/// ends at once. mpirun passes SIGUSR1 on and lets the ranks live; after SIGTERM it kills them.
class Interruptible {
 public:
  Interruptible();
  Interruptible(const Interruptible&) = delete;
  ~Interruptible();
  /// The signal that came, 0 for none.
  static int signal();

 private:
  static constexpr int signals[] = {SIGINT, SIGTERM, SIGUSR1};
  struct sigaction before_[std::size(signals)]{};
};

/// "3/7" as the third of seven parts of all trials, as even as whole trials allow; all of them if empty.
TrialRange range_of(const std::string& shard, std::uint64_t trials);

/// "continue with: wormdrive sweep ... --resume" after a command as it was typed, which may resume already.
std::string how_to_resume(const std::string& typed, bool resumes);

/// How a sweep ends that is made one trial after the other until one more has failed than may.
struct EarlyEnd {
  std::uint64_t end{};  ///< the first trial that it does not make
  std::string told;
};
/// Finds that in files which have every trial before, and perhaps others.
EarlyEnd ended_early(const std::vector<std::string>& parts, std::uint64_t max_failures);

/// Counts of the trials that files of a sweep have; reads none where no count decides about its end.
StoppingRule::Counts counted_in(const std::vector<std::string>& parts, const StoppingRule& rule);

/// Whether more trials have failed than may, of all so far, or of those that are enough: threads and ranks that are
/// ahead of the end may have failures of their own.
bool exceeds_failures(const SweepOptions& options, const StoppingRule& rule, std::uint64_t so_far);

/// Prints how many trials were enough, of a study that may end early.
void print_end(const Study& study, const StoppingRule& rule);

/// What a sweep spends its CPU time on [s].
struct SweepCost {
  double trials = 0.0, file = 0.0, referee = 0.0, summary = 0.0;
};

/// Lets CVODE judge trials of a sweep and writes what it finds: so many as are wanted, else at least eight, and more
/// while that takes less than 5 % of the time [s] that the trials took. Nothing where CVODE has made them itself. take:
/// counts one more trial of the sweep as judged, and returns how many were before.
std::vector<RefereeVerdict> judge(SweepFile& file, const Study& study, const SweepOptions& options, double trials_took,
                                  const std::function<std::uint64_t()>& take);

}  // namespace wormdrive
