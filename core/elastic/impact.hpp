#pragma once
#include <cmath>

#include "core/elastic/contact_law.hpp"
#include "core/mesh.hpp"

namespace wormdrive {

/// Mass [kg] that worm and gear oppose to a force between their teeth, 1/(a_g^2/Jg + a_g a_w/(i Jw)) with the lever
/// arms a of the normal force; Jg with the load.
inline double effective_mass(const GearMesh<double>& mesh, double Jg) {
  const double a_g = mesh.gear_arm(0.0), a_w = mesh.worm_arm(0.0);
  return 1.0 / (a_g * a_g / Jg + a_g * a_w / (mesh.i * mesh.Jw));
}

/// Angular frequency [rad/s] at which a mass swings on the teeth without damping; an impact lasts half a period.
inline double contact_frequency(const ToothContact<double>& contact, double mass) {
  return std::sqrt(contact.stiffness() / mass);
}

/// Of damping that grows with the penetration: c v - ln(1 + c v) is the same before and after [Hunt and Crossley 1975],
/// whatever stiffness and mass are.
double restitution(const HuntCrossley<double>& law, double, double speed);

/// Of a damper that is limited while the teeth approach. In units of time and speed in which mass, stiffness and
/// approach are 1, x'' = -2 x up to x = 2 zeta x', and from there on x'' = -x - 2 zeta x' until that is zero, at t:
/// the speed falls by e^(-zeta t), be the damping less or more than critical.
double restitution(const LimitedDamper<double>& law, double mass, double);

/// Speed at which the teeth part over the speed [m/s] at which they met, with no other force on the mass [kg].
inline double restitution(const ToothContact<double>& contact, double mass, double speed) {
  return std::visit([&](const auto& law) { return restitution(law, mass, speed); }, contact.law);
}

}  // namespace wormdrive
