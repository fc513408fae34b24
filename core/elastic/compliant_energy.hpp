#pragma once
#include <cmath>

#include "core/elastic/compliant_drive.hpp"
#include "core/energy.hpp"
#include "core/numbers/portable.hpp"

namespace wormdrive {

/// Kinetic energy of both bodies and elastic energy of the teeth [J].
template <class Load>
double stored_energy(const CompliantDrive<double, Load>& drive,
                     const typename CompliantDrive<double, Load>::Instant& now) {
  const Moment<double> at = drive.moment(now);
  double energy = 0.5 * (drive.mesh().Jw * at.omega_w * at.omega_w + drive.rigid().Jg(at) * at.omega_g * at.omega_g);
  for (const Flank flank : {Flank::left, Flank::right})
    if (const double d = drive.penetration(at, flank).first; d > 0.0)
      energy += 0.5 * drive.contact().stiffness() * d * d;
  return energy;
}

/// Where the power of a drive with elastic teeth goes: into friction, bearings and the damping of the contact. While
/// the worm is held the friction of the teeth may give back to a gear that swings what it took before.
template <class Load>
Power power(const CompliantDrive<double, Load>& drive, const typename CompliantDrive<double, Load>::Instant& now) {
  const Moment<double> at = drive.moment(now);
  const GearMesh<double>& mesh = drive.mesh();
  const auto input = drive.rigid().inputs(at, now.mode.gear);
  const double Wn = drive.normal_force(at, now.mode);
  double loss = drive.friction(at, now.mode, Wn) *
                (portable::cos(mesh.lambda) * mesh.lw * at.omega_w + portable::sin(mesh.lambda) * mesh.lg * at.omega_g);
  loss -= drive.effects().worm_torque(at, now.mode.worm) * at.omega_w +
          drive.effects().gear_torque(input.gear, at, now.mode.gear) * at.omega_g;
  for (const Flank flank : {Flank::left, Flank::right})
    if (const auto [d, v] = drive.penetration(at, flank); d > 0.0)
      loss += ((now.mode.contact == flank ? Wn : 0.0) - drive.contact().stiffness() * d) * v;
  return from_supply_on({(input.worm + drive.rigid().disturbance()) * at.omega_w, input.gear * at.omega_g, loss},
                        drive.effects(), winding(drive.effects(), drive.rigid().motor_command(at.t), at), at.omega_w);
}

}  // namespace wormdrive
