#include "sweep/rare/drive_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "statistics/normal.hpp"
#include "statistics/parallel.hpp"

namespace wormdrive {

DriveLimit::DriveLimit(const Study& study, const Threshold& threshold, unsigned threads, KeptRuns kept)
    : study_(study), threshold_(threshold), threads_(threads), kept_(std::move(kept)) {
  while (study.metrics[metric_].name != threshold.metric) ++metric_;
}

std::vector<double> DriveLimit::operator()(const std::vector<NormalPoint>& points,
                                           const std::vector<std::uint64_t>& noise) {
  std::vector<double> states(points.size());
  const std::uint64_t first = std::exchange(runs_, runs_ + points.size());
  parallel_for(points.size(), static_cast<int>(threads_),
               [&](std::size_t k) { states[k] = distance(run(first + k, points[k], noise[k])); });
  return states;
}

Trial DriveLimit::run(std::uint64_t number, const NormalPoint& point, std::uint64_t noise) {
  if (kept_.made)
    if (auto there = kept_.made(number)) return *std::move(there);
  Trial trial = made(point, noise);
  trial.index = number;
  if (kept_.keep) kept_.keep(trial);
  return trial;
}

Trial DriveLimit::made(const NormalPoint& point, std::uint64_t noise) {
  std::unique_ptr<Trials> trials;
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      trials = std::move(idle_.back());
      idle_.pop_back();
    }
  }
  if (!trials) trials = std::make_unique<Trials>(study_);
  std::vector<double> u(point.size());
  std::transform(point.begin(), point.end(), u.begin(),
                 [](double z) { return std::clamp(normal_probability(z), 0x1p-1000, 1.0 - 0x1p-53); });
  Trial made = trials->at(std::move(u), noise);
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(trials));
  return made;
}

double DriveLimit::distance(const Trial& trial) const {
  const double value = trial.metrics[metric_];
  if (trial.status != TrialStatus::done || std::isnan(value)) return -std::numeric_limits<double>::infinity();
  return threshold_.above ? threshold_.limit - value : value - threshold_.limit;
}

}  // namespace wormdrive
