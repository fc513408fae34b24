#pragma once
#include <cmath>

#include "core/worm_drive.hpp"

namespace wormdrive {

/// Where the power of a drive goes [W]; motor + load = loss + change of the kinetic energy, for a gear that closes.
struct Power {
  double motor;  ///< tau_m w_w, with what disturbs the worm's shaft
  double load;   ///< tau_l w_g
  double loss;   ///< friction of the mesh, mu Wn |sliding speed|, and of the bearings; rigid teeth never give it back
};

template <class Load>
Power power(const WormDrive<double, Load>& drive, const typename WormDrive<double, Load>::Instant& now) {
  const Moment<double> at = drive.moment(now);
  const Observation o = drive.observe(now);
  const Motion motion = now.mode.motion;
  const double bearings =
      -drive.effects().worm_torque(at, motion) * at.omega_w - drive.effects().gear_torque(at, motion) * at.omega_g;
  // where the pitch is uneven, the worm's lever arms are shorter as its speed is greater: an even pitch's speed counts
  const double mesh = drive.mesh().has_teeth ? drive.friction(at, motion) * o.normal_force *
                                                   std::abs(drive.mesh().sliding_speed(drive.mesh().i * at.omega_g))
                                             : 0.0;
  return {(o.tau_m + drive.disturbance()) * at.omega_w, o.tau_l * at.omega_g, bearings + mesh};
}

/// Kinetic energy (Jw theta_w'^2 + Jg theta_g'^2) / 2 [J].
template <class Load>
double stored_energy(const WormDrive<double, Load>& drive, const typename WormDrive<double, Load>::Instant& now) {
  const Moment<double> at = drive.moment(now);
  return 0.5 * (drive.mesh().Jw * at.omega_w * at.omega_w + drive.Jg() * at.omega_g * at.omega_g);
}

/// By how much the mesh creates or destroys normal power, C(0) i - 1; 0 for a gear that closes.
inline double closing_error(const GearMesh<double>& mesh) { return mesh.C(0.0) * mesh.i - 1.0; }

}  // namespace wormdrive
