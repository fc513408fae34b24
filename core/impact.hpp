#pragma once
#include <cmath>
#include <numbers>

#include "core/contact_law.hpp"
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

/// Speed at which the teeth part over the speed [m/s] at which they met, with no other force on the mass [kg].
inline double restitution(const ToothContact<double>& contact, double mass, double speed) {
  const double h = 1e-3 / contact_frequency(contact, mass);
  double d = 0.0, v = speed;
  const auto a = [&](double x, double rate) { return -contact.force(x, rate) / mass; };
  for (;;) {  // Runge-Kutta of order 4
    const double a1 = a(d, v), v2 = v + h / 2 * a1, a2 = a(d + h / 2 * v, v2), v3 = v + h / 2 * a2,
                 a3 = a(d + h / 2 * v2, v3), v4 = v + h * a3, a4 = a(d + h * v3, v4);
    d += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
    v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    if (v < 0.0 && contact.force(d, v) <= 0.0) return -v / speed;
  }
}

}  // namespace wormdrive
