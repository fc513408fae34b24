#pragma once
#include "core/compliant_drive.hpp"
#include "core/statics.hpp"

namespace wormdrive {

/// The state in which elastic teeth carry what acts on the gear at rest or at constant speed, so that a run does not
/// begin with a blow; in the middle of the gap where nothing acts. The drive has entered t [s].
template <class Load>
typename CompliantDrive<double, Load>::State carrying(const CompliantDrive<double, Load>& drive, double t,
                                                      double theta_g, double omega_g) {
  const GearMesh<double>& mesh = drive.mesh();
  const Moment<double> at = drive.rigid().moment(t, theta_g, omega_g);
  const Motion motion = omega_g > 0.0 ? Motion::forward : omega_g < 0.0 ? Motion::backward : Motion::stuck;
  const auto tau = drive.rigid().side_torques(at, motion);
  double force = forces_at_rest(mesh, tau.worm, tau.gear).normal;
  if (motion != Motion::stuck) {
    const Flank flank = tau.gear >= 0.0 ? Flank::left : Flank::right;
    force = tau.gear / mesh.gear_arm(Mode{motion, flank}.product() * drive.rigid().friction(at, motion));
  }
  const double side = force > 0.0 ? 1.0 : force < 0.0 ? -1.0 : 0.0;
  const double deflection =
      0.5 * side * drive.contact().backlash + force / (drive.contact().stiffness() * mesh.gear_arm(0.0));
  return {mesh.i * (theta_g - deflection), mesh.i * omega_g, theta_g, omega_g};
}

}  // namespace wormdrive
