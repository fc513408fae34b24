#pragma once
#include <cstddef>
#include <vector>

#include "description/scenario.hpp"

namespace wormdrive {

/// Motion of the gear, sample by sample [rad, rad/s, rad/s^2].
struct MeasuredMotion {
  std::vector<double> angle, speed, acceleration;
};

/// Samples on either side from which a speed is taken; period [s].
std::size_t slope_half_width(double period);

/// Speed and acceleration out of an angle, by a parabola through `half_width` samples on either side.
MeasuredMotion measured_motion(const std::vector<double>& angle, double period, std::size_t half_width);

/// The motor torque that the drive of a scenario would need for a motion [N m], its inverse dynamics; zero where the
/// gear is slower than `still` [rad/s], for rest does not tell the torque.
std::vector<double> needed_torque(const Scenario& scenario, const MeasuredMotion& motion,
                                  const std::vector<double>& time, double still);

/// The largest acceleration at the gear that a motor torque up to this size can cause [rad/s^2].
double largest_acceleration(const Scenario& scenario, double torque);

}  // namespace wormdrive
