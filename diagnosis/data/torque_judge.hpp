#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "diagnosis/data/needed_torque.hpp"
#include "diagnosis/data/recorded_table.hpp"
#include "diagnosis/rules/recordings.hpp"
#include "statistics/sizes.hpp"

namespace wormdrive {

/// How well a torque is the one that a motion needs.
struct TorqueFit {
  double missed = 1e9;                 ///< median size of what is left over that of the torque
  double missed_rms = 1e9;             ///< the same by root mean squares, which no half of the motion escapes
  double missed_but_for_offset = 1e9;  ///< the same if a constant torque is added that leaves least
  double factor = 1.0;                 ///< median size of the torque over that of the need
  double factor_rms = 1.0;  ///< the same by root mean squares, which a motor that is off for a while hardly changes
};

/// Compares recorded torques with those that a drive needs for the recorded motion, by its inverse dynamics. What does
/// not depend on the drive is worked out once.
class TorqueJudge {
 public:
  /// Torque [N m] and gear angle [rad] in place of the table's own, one every `period` [s].
  TorqueJudge(const RecordedTable& table, const std::vector<double>& torque, const std::vector<double>& angle,
              double period)
      : table_(table),
        half_width_(slope_half_width(period)),
        motion_(measured_motion(angle, period, half_width_)),
        still_(std::max(rules::too_slow_for_torque * median_size(motion_.speed), 1e-9)),
        mean_(torque.size()) {
    const std::size_t w = half_width_;
    for (std::size_t k = w; k + w < torque.size(); ++k)
      for (std::size_t j = k - w; j < k + w; ++j) mean_[k] += torque[j] / static_cast<double>(2 * w);
  }

  TorqueFit fit(const Scenario& scenario) const {
    const std::vector<double> needed = needed_torque(scenario, motion_, table_.time.values, still_);
    std::vector<double> left, given, asked;
    for (std::size_t k = half_width_; k + half_width_ < mean_.size(); ++k) {
      if (needed[k] == 0.0 || table_.crosses_pause(k, half_width_)) continue;
      left.push_back(mean_[k] - needed[k]);
      given.push_back(mean_[k]);
      asked.push_back(needed[k]);
    }
    if (given.size() < rules::fewest_for_torque || rms(given) == 0.0 || median_size(asked) == 0.0) return {};
    const double offset = std::accumulate(left.begin(), left.end(), 0.0) / static_cast<double>(left.size());
    const double varying = std::sqrt(std::max(0.0, rms(left) * rms(left) - offset * offset));
    return {median_size(left) / median_size(given), rms(left) / rms(given), varying / rms(given),
            median_size(given) / median_size(asked), rms(given) / rms(asked)};
  }

 private:
  const RecordedTable& table_;
  std::size_t half_width_;
  MeasuredMotion motion_;
  double still_;              ///< speed below which rest does not tell the torque [rad/s]
  std::vector<double> mean_;  ///< of the torque over as many samples as the motion is [N m]
};

}  // namespace wormdrive
