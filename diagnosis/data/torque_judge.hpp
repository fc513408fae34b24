#pragma once
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "diagnosis/data/needed_torque.hpp"
#include "statistics/sizes.hpp"

namespace wormdrive {

/// How well a torque is the one that a motion needs.
struct TorqueFit {
  double missed = 1e9;      ///< median size of what is left over that of the torque
  double missed_rms = 1e9;  ///< the same by root mean squares, which no half of the motion escapes
  double factor = 0.0;      ///< median size of the torque over that of the need
};

/// Compares recorded torques with those that the drive of a scenario needs for the recorded motion, by its inverse
/// dynamics.
class TorqueJudge {
 public:
  TorqueJudge(const Scenario& scenario, double start, double period)
      : scenario_(scenario), start_(start), period_(period), half_width_(std::max(4L, std::lround(0.012 / period))) {}

  TorqueFit fit(const std::vector<double>& torque, const std::vector<double>& angle) const {
    const auto w = static_cast<std::size_t>(half_width_);
    const MeasuredMotion motion = measured_motion(angle, period_, w);
    const double still = std::max(0.3 * median_size(motion.speed), 1e-9);
    const std::vector<double> needed = needed_torque(scenario_, motion, start_, period_, still);
    std::vector<double> left, given, asked;
    for (std::size_t k = w; k + w < torque.size(); ++k) {
      if (needed[k] == 0.0) continue;
      double mean = 0.0;
      for (std::size_t j = k - w; j < k + w; ++j) mean += torque[j] / static_cast<double>(2 * w);
      left.push_back(mean - needed[k]);
      given.push_back(mean);
      asked.push_back(needed[k]);
    }
    if (given.size() < 100 || median_size(given) == 0.0 || median_size(asked) == 0.0) return {};
    return {median_size(left) / median_size(given), rms(left) / rms(given), median_size(given) / median_size(asked)};
  }

 private:
  const Scenario& scenario_;
  double start_, period_;
  long half_width_;
};

}  // namespace wormdrive
