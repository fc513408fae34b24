#pragma once
#include <algorithm>
#include <cmath>

#include <boost/math/special_functions/log1p.hpp>

#include "core/elastic/contact_law.hpp"
#include "core/mesh.hpp"
#include "core/numbers/crossing.hpp"

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
inline double restitution(const HuntCrossley<double>& law, double, double speed) {
  const double x = law.damping * speed;
  if (x < 1e-8) return 1.0 - 2.0 / 3.0 * x;  // to rounding
  const double before = boost::math::log1pmx(x);
  const auto more_than_before = [before](double y) { return before - boost::math::log1pmx(-y); };
  // Teeth part more slowly than they met, and more slowly than 1/c: at that speed the law would no longer push.
  const double most = std::min(x, std::nextafter(1.0, 0.0)), excess = more_than_before(most);
  return (excess > 0.0 ? root_between(FunctionView<double>(more_than_before), 0.0, before, most, excess) : most) / x;
}

/// Of a damper that is limited while the teeth approach. In units of time and speed in which mass, stiffness and
/// approach are 1, x'' = -2 x up to x = 2 zeta x', and from there on x'' = -x - 2 zeta x' until that is zero, at t:
/// the speed falls by e^(-zeta t), be the damping less or more than critical.
inline double restitution(const LimitedDamper<double>& law, double mass, double) {
  const double zeta = 0.5 * law.damping / (std::sqrt(law.stiffness) * std::sqrt(mass));
  if (zeta <= 1.0) {
    const double delta = std::sqrt((1.0 - zeta) * (1.0 + zeta));
    const double t = delta > 0.0 ? std::atan2(4.0 * zeta * delta, 4.0 * zeta * zeta - 1.0) / delta : 4.0 / 3.0;
    return std::exp(-zeta * t);
  }
  const double share = std::sqrt((1.0 - 1.0 / zeta) * (1.0 + 1.0 / zeta));  // of zeta: what the fast motion has more
  return std::exp(-std::asinh(4.0 * zeta * share / std::hypot(1.0 / zeta, std::sqrt(8.0))) / share);
}

/// Speed at which the teeth part over the speed [m/s] at which they met, with no other force on the mass [kg].
inline double restitution(const ToothContact<double>& contact, double mass, double speed) {
  return std::visit([&](const auto& law) { return restitution(law, mass, speed); }, contact.law);
}

}  // namespace wormdrive
