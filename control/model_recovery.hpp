#pragma once
#include <algorithm>
#include <cmath>

#include "control/controller_signals.hpp"
#include "control/nominal.hpp"

namespace wormdrive {

/// Anti-windup by model recovery: a model of M theta'' = tau follows what the limit of the actuator has taken away. The
/// law sees the drive less the model, as if there were no limit, and a torque of its own brings the model back to 0.
///
/// Source: L. Zaccarian, A. R. Teel, Modern Anti-windup Synthesis, Princeton 2011, chapter 6. The torque is that of
/// proximate time-optimal control [M. L. Workman, R. L. Kosut, G. F. Franklin, Proc. CDC 1987, 1549-1553].
class ModelRecovery {
 public:
  /// tracking_time [s]: near 0 the model has a double pole at half its inverse. Less than a sample counts as one: a
  /// faster model would overshoot 0 at every sample.
  ModelRecovery(const NominalModel& nominal, double tracking_time)
      : nominal_(nominal), inertia_(mean_inertia(nominal)), rate_(1.0 / tracking_time) {}

  /// What law(seen) decides for the drive that it is shown, with the torque that brings the model back.
  template <class Law>
  ControlSignals operator()(Law&& law, const Measurement& m) {
    const double missing = (m.applied - asked_) / inertia_;  // acceleration [rad/s^2], 0 within the limit
    angle_ += speed_ * m.period + 0.5 * missing * m.period * m.period;
    speed_ += missing * m.period;
    Measurement seen = m;
    seen.angle -= angle_;
    seen.speed -= speed_;
    ControlSignals decided = law(seen);
    asked_ = decided.torque;
    const double rate = std::min(rate_, 1.0 / m.period);  // no limit at the first sample, where the model is at rest
    decided.torque += inertia_ * rate * (wanted_speed(m, 0.25 * rate) - speed_);
    return decided;
  }
  /// Calls visit(number) for every number that samples change.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    visit(angle_);
    visit(speed_);
    visit(asked_);
  }

 private:
  /// With how much of the torque beside the load's the model brakes; the rest is for what the nominal model does not
  /// know. Workman calls it the acceleration discount factor.
  static constexpr double share = 0.8;

  /// The speed at which the model still comes to rest at 0: linear near 0, then as braking allows.
  double wanted_speed(const Measurement& m, double slope) const {
    const double hold = std::max(std::abs(nominal_.C1), std::abs(nominal_.C2)) * std::abs(nominal_.load(m.angle));
    const double braking = share * std::max(m.limit - hold, 0.0) / inertia_, distance = std::abs(angle_);
    const double near = braking / (slope * slope);
    if (distance < near) return -slope * angle_;
    return -std::copysign(std::sqrt(braking * (2.0 * distance - near)), angle_);
  }

  NominalModel nominal_;
  double inertia_;      ///< [kg m^2]
  double rate_;         ///< [1/s]
  double angle_ = 0.0;  ///< of the model: by how much the drive is ahead of one without a limit [rad]
  double speed_ = 0.0;  ///< likewise [rad/s]
  double asked_ = 0.0;  ///< by the law at the sample before [N m]
};

}  // namespace wormdrive
