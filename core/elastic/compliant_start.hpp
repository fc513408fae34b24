#pragma once
#include <algorithm>
#include <cmath>

#include "core/elastic/compliant_drive.hpp"
#include "core/numbers/rounded.hpp"
#include "core/statics.hpp"

namespace wormdrive {

/// What acts on the gear [N m]; 0 where that is no more than the rounding of the drive's torques.
template <class Load>
double load_on_gear(const WormDrive<double, Load>& drive, double t, double theta_g, double omega_g, Motion motion) {
  const auto tau = drive.side_torques(drive.template moment<Rounded>(t, theta_g, omega_g), motion);
  return std::abs(tau.gear.value) > tau.gear.rounding + drive.mesh().i * tau.worm.rounding ? tau.gear.value : 0.0;
}

/// Wn [N] with which the teeth carry a load on the gear [N m] while the worm slides. Where friction drags the gear
/// along more than the load does nothing balances it, and the teeth only touch.
template <class Load>
double force_in_sliding(const WormDrive<double, Load>& drive, const Moment<double>& at, double load, Mode mode) {
  const double arm = drive.mesh().gear_arm(mode.product() * drive.friction(at, mode.motion));
  return arm > 0.0 ? std::abs(load) / arm : 0.0;
}

/// The same at rest: as much as both bodies at rest ask for, if the friction that goes with it holds the worm; else as
/// in the sliding that begins, so that the force is that of the moment after.
template <class Load>
double force_at_rest(const WormDrive<double, Load>& drive, const Moment<double>& at, double load, Flank flank) {
  const double tau_w = drive.side_torques(at, Motion::stuck).worm;
  for (const Motion motion : {Motion::forward, Motion::backward}) {
    const Mode mode{motion, flank};
    const double force = force_in_sliding(drive, at, load, mode);
    const double arm = drive.mesh().worm_arm(mode.product() * drive.friction(at, motion));
    if (force > 0.0 && sign(motion) * (tau_w + sign(flank) * force * arm) > 0.0) return force;
  }
  return std::max(0.0, sign(flank) * forces_at_rest(drive.mesh(), tau_w, load).normal);
}

/// The state in which elastic teeth carry the load on the gear at rest or at constant speed, so that a run does not
/// begin with a blow; in the middle of the gap where nothing acts on the gear. The drive has entered t [s].
template <class Load>
typename CompliantDrive<double, Load>::State carrying(const CompliantDrive<double, Load>& drive, double t,
                                                      double theta_g, double omega_g) {
  const WormDrive<double, Load>& rigid = drive.rigid();
  const GearMesh<double>& mesh = drive.mesh();
  const Moment<double> at = rigid.moment(t, theta_g, omega_g);
  const Motion motion = omega_g > 0.0 ? Motion::forward : omega_g < 0.0 ? Motion::backward : Motion::stuck;
  const double load = load_on_gear(rigid, t, theta_g, omega_g, motion);
  const Flank flank = load > 0.0 ? Flank::left : load < 0.0 ? Flank::right : Flank::none;
  const double force = motion == Motion::stuck ? force_at_rest(rigid, at, load, flank)
                                               : force_in_sliding(rigid, at, load, Mode{motion, flank});
  const double deflection =
      sign(flank) * (0.5 * drive.contact().backlash + force / (drive.contact().stiffness() * mesh.gear_arm(0.0)));
  return {mesh.i * (theta_g - deflection), mesh.i * omega_g, theta_g, omega_g};
}

}  // namespace wormdrive
