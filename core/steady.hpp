#pragma once
#include "core/worm_drive.hpp"

namespace wormdrive {

/// Motor torque tau_m [N m] that keeps a drive at constant speed: theta_g'' = 0 in [YehWu2009, eq. 18-19].
/// The flank follows from the load, for on the switching surface theta_g'' = tau_g/Jg. omega_w [rad/s] is not 0.
template <class Load>
double steady_torque(const GearMesh<double>& mesh, const Effects<double>& effects, const Load& load, double omega_w,
                     double theta_g, double t) {
  const Moment<double> at{t, theta_g, omega_w / mesh.i, omega_w};
  const Motion motion = omega_w > 0.0 ? Motion::forward : Motion::backward;
  const double tau_g = load.torque(at) + effects.gear_torque(at, motion);
  const Flank flank = tau_g >= 0.0 ? Flank::left : Flank::right;
  return -mesh.C(Mode{motion, flank}.product() * mesh.mu) * tau_g - effects.worm_torque(at, motion);
}

}  // namespace wormdrive
