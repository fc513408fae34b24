#include "recovery/truth/size.hpp"

#include <cmath>

namespace truth {
namespace {

struct Magnitudes {
  double worm_torque, gear_torque, sliding_per_gear_speed;
};

Magnitudes magnitudes(const Sheet& sheet) {
  const Geometry& g = sheet.geometry;
  const double gear = g.mass * g.gravity * g.arm + (g.gear_inertia + g.mass * g.arm * g.arm) * usual_acceleration;
  return {g.worm_inertia * g.ratio * usual_acceleration + torque_ratio(g, sheet.friction) * gear, gear,
          g.worm_radius / std::cos(g.lead_angle) * g.ratio};
}

double magnitude(Dimension dimension, const Sheet& sheet) {
  const Magnitudes m = magnitudes(sheet);
  switch (dimension) {
    case Dimension::plain: return 1.0;
    case Dimension::friction: return sheet.friction;
    case Dimension::worm_torque: return m.worm_torque;
    case Dimension::worm_viscous:
    case Dimension::worm_inertia: return m.worm_torque / sheet.geometry.ratio;
    case Dimension::gear_torque:
    case Dimension::gear_viscous:
    case Dimension::gear_inertia: return m.gear_torque;
    case Dimension::gear_compliance: return 1.0 / m.gear_torque;
    case Dimension::sliding_speed: return m.sliding_per_gear_speed;
  }
  return 1.0;
}

}  // namespace

double torque_ratio(const Geometry& g, double friction) {
  const double cp = std::cos(g.pressure_angle), sl = std::sin(g.lead_angle), cl = std::cos(g.lead_angle);
  return g.worm_radius / g.gear_radius * (cp * sl + friction * cl) / (cp * cl - friction * sl);
}

double times_usual(Dimension dimension, const Sheet& sheet) {
  return magnitude(dimension, sheet) / magnitude(dimension, {});
}

}  // namespace truth
