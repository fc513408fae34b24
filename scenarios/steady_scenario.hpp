#pragma once
#include "core/steady.hpp"
#include "scenarios/build.hpp"

namespace wormdrive {

/// The motor torque [N m] that keeps the drive of a scenario at a worm speed [rad/s], with the load of time 0 and the
/// initial angle.
inline double steady_torque(const Scenario& scenario, double worm_speed) {
  return with_drive(scenario, [&](auto& drive) {
    drive.enter(0.0);
    return steady_torque(drive, worm_speed, scenario.initial.theta_g, 0.0);
  });
}

}  // namespace wormdrive
