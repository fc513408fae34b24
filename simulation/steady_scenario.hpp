#pragma once
#include <optional>
#include <tuple>

#include "core/steady.hpp"
#include "description/build.hpp"

namespace wormdrive {

/// A scenario whose drive turns at constant speed: its brake is open, if it ever opens.
inline Scenario with_open_brake(Scenario scenario) {
  auto& brake = std::get<std::optional<HoldingBrake<double>>>(scenario.effects.list);
  if (brake && (brake->opens || brake->closes)) brake.reset();
  return scenario;
}

/// The motor torque [N m] that keeps the drive of a scenario at a worm speed other than 0 [rad/s], with the load of
/// time 0 and the initial angle.
inline double steady_torque(const Scenario& scenario, double worm_speed) {
  auto drive = make_drive(with_open_brake(scenario));
  drive.enter(0.0);
  return steady_torque(drive, worm_speed, scenario.initial.theta_g, 0.0);
}

/// The commands to the motor [N m] from the lowest to the highest under which the drive of a scenario stays at rest, at
/// time 0 and the initial angle after a long rest, all effects included; and its load [N m] there.
struct RestAtStart {
  double low, high, load;
};
inline RestAtStart rest_at_start(const Scenario& scenario) {
  auto drive = make_drive(scenario);
  drive.enter(0.0);
  const double at = scenario.initial.theta_g;
  return {break_in_torque(drive, Motion::backward, at, 0.0), break_in_torque(drive, Motion::forward, at, 0.0),
          drive.inputs(drive.moment(0.0, at, 0.0), Motion::stuck).gear};
}

}  // namespace wormdrive
