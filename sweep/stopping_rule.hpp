#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sweep/study/study.hpp"
#include "sweep/trial.hpp"

namespace wormdrive {

/// Ends a sweep once its thresholds are missed in shares that are known as well as the study asks for.
///
/// It looks at the first 100 trials, and whenever there are a tenth more, always at all trials up to a fixed one: the
/// end is the same in whatever order trials are made, and by whom. Repeated looks make an interval too narrow; here
/// hardly, for its width follows from the number of misses, so that a sweep ends when a nearly fixed number has missed
/// [Haldane1945].
class StoppingRule {
 public:
  /// Of trials, for every look since the one before: how many were made, how many of them are not done, and how many
  /// miss each threshold. Those of several processes add up.
  using Counts = std::vector<std::uint64_t>;

  explicit StoppingRule(const Study& study);

  /// Counts of no trial.
  Counts none() const { return Counts(looks_.size() * numbers_per_look()); }
  /// Counts a trial, in any order.
  void count(const Trial& trial, Counts& counts) const;
  /// Looks at the counts of all trials that are made so far.
  void look(std::span<const std::uint64_t> counts);
  /// Both, of a process that makes all trials.
  void take(const Trial& trial, Counts& counts) {
    count(trial, counts);
    look(counts);
  }

  /// How many trials are enough; nothing as long as nobody knows.
  std::optional<std::uint64_t> end() const { return end_; }
  /// How many of these are not done.
  std::uint64_t failed() const { return failed_; }

 private:
  struct Watched {
    Threshold threshold;
    std::size_t place;  ///< of its metric
    Metric metric;
  };
  std::size_t numbers_per_look() const { return 2 + watched_.size(); }
  bool is_enough(std::uint64_t trials) const;

  std::vector<Watched> watched_;
  std::vector<std::uint64_t> looks_;   ///< trials before these count
  std::size_t next_ = 0;               ///< look whose trials are not all there
  std::vector<std::uint64_t> missed_;  ///< before it, of each threshold
  std::uint64_t failed_ = 0;           ///< likewise
  std::optional<std::uint64_t> end_;
};

/// Adds numbers to as many others, one by one.
inline void add(StoppingRule::Counts& to, std::span<const std::uint64_t> more) {
  for (std::size_t k = 0; k < to.size(); ++k) to[k] += more[k];
}

}  // namespace wormdrive
