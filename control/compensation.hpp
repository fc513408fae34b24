#pragma once
#include "control/nominal.hpp"
#include "core/numbers/lanes.hpp"

namespace wormdrive {

/// Break-in compensation [N m] added while |theta_g'| <= epsilon [YehWu2009, eq. 25]: the torque that brings the gear
/// to the edge of motion in the direction of theta_d'. The paper's two torques swap for tau_l_hat < 0 (eq. 9-10).
template <class V>
[[gnu::always_inline]] inline V break_in_compensation(const V& C1, const V& C2, const V& load, const V& speed,
                                                      double desired_speed, const V& epsilon) {
  const auto fast = abs(speed) > epsilon;
  if (all(fast)) return 0.0;
  const auto swapped = load < 0.0;
  const V C = desired_speed >= 0.0 ? select(swapped, C2, C1) : select(swapped, C1, C2);
  return select(fast, 0.0, -C * load);
}

inline double break_in_compensation(const NominalModel& nominal, double load, double speed, double desired_speed,
                                    double epsilon) {
  return break_in_compensation<double>(nominal.C1, nominal.C2, load, speed, desired_speed, epsilon);
}

/// Where the direction that selects a controller's branch is forward: that of the measured speed, at zero speed of the
/// reference.
template <class V>
[[gnu::always_inline]] inline MaskOf<V> goes_forward(const V& speed, double desired_speed) {
  return select(speed != 0.0, speed, V(desired_speed)) >= 0.0;
}

}  // namespace wormdrive
