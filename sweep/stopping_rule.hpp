#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "sweep/study/study.hpp"
#include "sweep/trial.hpp"

namespace wormdrive {

/// Ends a sweep once its thresholds are missed in shares that are known as well as the study asks for.
///
/// It looks at the first 100 trials, and whenever there are a tenth more, always at all trials up to a fixed one: the
/// end is the same in whatever order trials are made. Repeated looks make an interval too narrow; here hardly, for its
/// width follows from the number of misses, so that a sweep ends when a nearly fixed number has missed [Haldane1945].
class StoppingRule {
 public:
  explicit StoppingRule(const Study& study);

  /// Takes a trial, in any order.
  void take(const Trial& trial);
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
  struct Look {
    std::uint64_t end;                   ///< trials before it count
    std::uint64_t made = 0, failed = 0;  ///< of those since the look before
    std::vector<std::uint64_t> missed;   ///< likewise, of each threshold
  };
  bool is_enough(std::uint64_t trials) const;

  std::vector<Watched> watched_;
  std::vector<Look> looks_;
  std::size_t next_ = 0;               ///< look whose trials are not all there
  std::vector<std::uint64_t> missed_;  ///< before it, of each threshold
  std::uint64_t failed_ = 0;           ///< likewise
  std::optional<std::uint64_t> end_;
};

}  // namespace wormdrive
