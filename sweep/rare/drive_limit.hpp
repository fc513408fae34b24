#pragma once
#include <memory>
#include <mutex>
#include <vector>

#include "sweep/rare/limit_state.hpp"
#include "sweep/trial.hpp"

namespace wormdrive {

/// The limit state of a study: how far the metric of a threshold is from its limit, in the metric's unit. A drive that
/// cannot run, does not come to its end or has no value misses the limit.
class DriveLimit {
 public:
  /// The study must outlive it.
  DriveLimit(const Study& study, const Threshold& threshold, unsigned threads);

  std::vector<double> operator()(const std::vector<NormalPoint>& points, const std::vector<std::uint64_t>& noise);
  /// The trial at a point.
  Trial trial(const NormalPoint& point, std::uint64_t noise);

 private:
  double distance(const Trial& trial) const;

  const Study& study_;
  Threshold threshold_;
  std::size_t metric_ = 0;
  unsigned threads_;
  std::vector<std::unique_ptr<Trials>> idle_;  ///< what makes trials, one for each thread
  std::mutex mutex_;
};

}  // namespace wormdrive
