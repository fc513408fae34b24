#pragma once
#include <numbers>

#include "core/numbers/lanes.hpp"
#include "core/numbers/portable.hpp"

namespace wormdrive {

/// Backward difference of the measured angle behind a one-pole low-pass, of one trial or of several at once.
template <class V>
class SpeedEstimatorOf {
 public:
  SpeedEstimatorOf() = default;
  SpeedEstimatorOf(double cutoff, double period)
      : gain_(cutoff > 0.0 ? 1.0 - portable::exp(-2.0 * std::numbers::pi * cutoff * period) : 1.0),
        rate_(1.0 / period) {}

  /// Starts from an angle [rad] at which nothing has moved yet.
  void start(const V& angle) { previous_ = angle; }
  /// The speed [rad/s] after one more sample.
  [[gnu::always_inline]] V operator()(const V& angle) {
    speed_ += gain_ * ((angle - previous_) * rate_ - speed_);
    previous_ = angle;
    return speed_;
  }
  /// Calls visit(number) for every number that samples change.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    visit(previous_);
    visit(speed_);
  }

 private:
  V gain_, rate_, previous_ = 0.0, speed_ = 0.0;
};
using SpeedEstimator = SpeedEstimatorOf<double>;

}  // namespace wormdrive
