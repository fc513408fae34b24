#pragma once
#include <cmath>

#include "control/nominal.hpp"

namespace wormdrive {

/// Break-in compensation [N m] added while |theta_g'| <= epsilon [YehWu2009, eq. 25]: the torque that brings the gear
/// to the edge of motion in the direction of theta_d'. The paper's two torques swap for tau_l_hat < 0 (eq. 9-10).
inline double break_in_compensation(const NominalModel& nominal, double load, double speed, double desired_speed,
                                    double epsilon) {
  if (std::abs(speed) > epsilon) return 0.0;
  const bool forward = desired_speed >= 0.0, swapped = load < 0.0;
  return -(forward != swapped ? nominal.C1 : nominal.C2) * load;
}

/// The direction that selects a controller's branch: of the measured speed, at zero speed of the reference.
inline Motion branch(double speed, double desired_speed) {
  const double decisive = speed != 0.0 ? speed : desired_speed;
  return decisive >= 0.0 ? Motion::forward : Motion::backward;
}

}  // namespace wormdrive
