#pragma once
#include <limits>

#include "core/worm_drive.hpp"

namespace wormdrive {

/// Command to the motor [N m] with which a drive does not accelerate at a moment while it moves, or starts to move, in
/// a direction: theta_g'' = 0 in [YehWu2009, eq. 18-19]. Without effects of the actuator it is the motor torque tau_m.
/// The flank follows from the load, for on the switching surface theta_g'' = tau_g/Jg.
template <class Load>
double balancing_torque(const WormDrive<double, Load>& drive, const Moment<double>& at, Motion motion) {
  const double tau_g = drive.side_torques(at, motion).gear;
  const Flank flank = tau_g >= 0.0 ? Flank::left : Flank::right;
  const double C = drive.mesh().C(Mode{motion, flank}.product() * drive.friction(at, motion));
  const Transmission<double> worm = drive.effects().transmission(at.theta_g);
  const double inertial = drive.mesh().Jw * drive.mesh().i * worm.curvature * at.omega_g * at.omega_g;
  const double tau_m = inertial - C / worm.slope * tau_g - drive.effects().worm_torque(at, motion);
  // what the motor gives is offset + gain command
  const double offset = drive.effects().motor_torque(0.0, at), gain = drive.effects().motor_torque(1.0, at) - offset;
  return (tau_m - offset) / gain;
}

/// Command [N m] that keeps a drive at a constant gear speed. The drive has entered t [s]; omega_w [rad/s], the worm
/// speed at an even pitch, is not 0.
template <class Load>
double steady_torque(const WormDrive<double, Load>& drive, double omega_w, double theta_g, double t) {
  const Moment<double> at = drive.moment(t, theta_g, omega_w / drive.mesh().i);
  return balancing_torque(drive, at, omega_w > 0.0 ? Motion::forward : Motion::backward);
}

/// Command [N m] at which a drive that has rested long starts to move in a direction, bearings and all effects
/// included [YehWu2009, eq. 9-10]. The drive has entered t [s].
template <class Load>
double break_in_torque(const WormDrive<double, Load>& drive, Motion motion, double theta_g, double t) {
  Moment<double> at = drive.moment(t, theta_g, 0.0);
  at.rest = std::numeric_limits<double>::infinity();
  return balancing_torque(drive, at, motion);
}

}  // namespace wormdrive
