#pragma once
#include "core/worm_drive.hpp"

namespace wormdrive {

/// Where the power of a drive goes [W]; motor + load = loss + change of the stored energy, for a gear that closes.
struct Power {
  double motor;  ///< tau_m w_w, with what disturbs the worm's shaft; with a winding from its supply on
  double load;   ///< tau_l w_g
  double loss;   ///< of friction in mesh and bearings; rigid teeth never give it back; with a winding its heat
};

/// The power of the motor and its losses from the supply on, out of those from the shaft on.
inline Power from_supply_on(Power at_shaft, const Effects<double>& effects, const std::optional<Winding>& winding,
                            double omega_w) {
  if (!winding) return at_shaft;
  at_shaft.motor += winding->power() - dc_motor(effects)->torque_constant * winding->current * omega_w;
  at_shaft.loss += winding->loss;
  return at_shaft;
}

template <class Load, bool with_states>
Power power(const WormDrive<double, Load, with_states>& drive,
            const typename WormDrive<double, Load, with_states>::Instant& now) {
  const auto at = drive.moment(now);
  const Observation o = drive.observe(now);
  const Power at_shaft{(o.tau_m + drive.disturbance()) * at.omega_w, o.tau_l * at.omega_g,
                       drive.friction_loss(at, now.mode)};
  return from_supply_on(at_shaft, drive.effects(), o.winding, at.omega_w);
}

/// Kinetic energy (Jw theta_w'^2 + Jg theta_g'^2) / 2 [J], and the energy of the winding if its current is a state.
template <class Load, bool with_states>
double stored_energy(const WormDrive<double, Load, with_states>& drive,
                     const typename WormDrive<double, Load, with_states>::Instant& now) {
  const auto at = drive.moment(now);
  const double kinetic = 0.5 * (drive.mesh().Jw * at.omega_w * at.omega_w + drive.Jg(at) * at.omega_g * at.omega_g);
  if constexpr (with_states)
    return kinetic + stored_energy(drive.effects(), winding(drive.effects(), drive.motor_command(at.t), at));
  else
    return kinetic;
}

/// By how much the mesh creates or destroys normal power, C(0) i - 1; 0 for a gear that closes.
inline double closing_error(const GearMesh<double>& mesh) { return mesh.C(0.0) * mesh.i - 1.0; }

}  // namespace wormdrive
