#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "sweep/rare/limit_state.hpp"
#include "sweep/trial.hpp"

namespace wormdrive {

/// Runs that are there from before, by their number, and who keeps those that are made; nobody, if empty.
struct KeptRuns {
  std::function<std::optional<Trial>(std::uint64_t)> made;
  std::function<void(Trial)> keep;  ///< called from several threads
};

/// The limit state of a study: how far the metric of a threshold is from its limit, in the metric's unit. A drive that
/// cannot run, does not come to its end or has no value misses the limit.
class DriveLimit {
 public:
  /// The study must outlive it.
  DriveLimit(const Study& study, const Threshold& threshold, unsigned threads, KeptRuns kept = {});

  std::vector<double> operator()(const std::vector<NormalPoint>& points, const std::vector<std::uint64_t>& noise);
  /// The trial at a point.
  Trial trial(const NormalPoint& point, std::uint64_t noise) { return run(runs_++, point, noise); }

 private:
  /// The run of a number, counted in the order in which they are asked for.
  Trial run(std::uint64_t number, const NormalPoint& point, std::uint64_t noise);
  Trial made(const NormalPoint& point, std::uint64_t noise);
  double distance(const Trial& trial) const;

  const Study& study_;
  Threshold threshold_;
  std::size_t metric_ = 0;
  unsigned threads_;
  KeptRuns kept_;
  std::uint64_t runs_ = 0;
  std::vector<std::unique_ptr<Trials>> idle_;  ///< what makes trials, one for each thread
  std::mutex mutex_;
};

}  // namespace wormdrive
