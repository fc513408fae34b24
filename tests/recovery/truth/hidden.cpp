#include "recovery/truth/hidden.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace truth {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

double between(Generator& generator, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(generator);
}
double by_ratio(Generator& generator, double low, double high) {
  return low * std::pow(high / low, between(generator, 0.0, 1.0));
}
double normal_arm(const Drive& d) {
  return d.geometry.gear_radius * std::cos(d.geometry.pressure_angle) * std::cos(d.geometry.lead_angle);
}

// clang-format off
const std::vector<Secret> known{
    {"mesh_friction", 0.005, 0.015, 0.045, true, false,
     [](Drive& d, double s, Generator&) { d.friction.level += s; },
     {{"change", [](const Drive& d) { return d.friction.level - d.sheet.friction; }}}, Dimension::friction},
    {"stribeck", 0.01, 0.03, 0.09, true, false,
     [](Drive& d, double s, Generator& g) {
       d.friction.drop = s;
       d.friction.fall_speed = by_ratio(g, 0.06, 0.4) * times_usual(Dimension::sliding_speed, d.sheet);
       using enum MeshFriction::Fall;
       const double law = between(g, 0, 3);
       d.friction.fall = law < 1.0 ? gaussian : law < 2.0 ? lorentzian : hyperbolic;
     },
     {{"drop", [](const Drive& d) { return d.friction.drop; }}}, Dimension::friction},
    {"friction_asymmetry", 0.004, 0.012, 0.036, true, false,
     [](Drive& d, double s, Generator&) { d.friction.asymmetry = s; },
     {{"change", [](const Drive& d) { return d.friction.asymmetry; }}}, Dimension::friction},
    {"position_friction", 0.02, 0.06, 0.18, true, false,
     [](Drive& d, double s, Generator& g) { d.friction.wave = s; d.friction.wave_phase = between(g, 0, turn); },
     {{"amplitude", [](const Drive& d) { return std::abs(d.friction.wave); }}}},
    {"thread_friction", 0.02, 0.06, 0.18, true, false,
     [](Drive& d, double s, Generator& g) { d.friction.worm_wave = s; d.friction.worm_wave_phase = between(g, 0, turn); },
     {{"amplitude", [](const Drive& d) { return std::abs(d.friction.worm_wave); }}}},
    {"friction_drift", 0.03, 0.09, 0.27, true, false,
     [](Drive& d, double s, Generator&) { d.friction.drift = s; }, {{"share", [](const Drive& d) { return d.friction.drift; }}}},
    {"static_friction", 0.01, 0.03, 0.09, false, false,
     [](Drive& d, double s, Generator&) { d.friction.rise = s; }, {{"rise", [](const Drive& d) { return d.friction.rise; }}}, Dimension::friction},
    {"worm_coulomb", 1e-3, 3e-3, 1e-2, false, false,
     [](Drive& d, double s, Generator&) { d.bearings.worm_coulomb = s; },
     {{"torque", [](const Drive& d) { return d.bearings.worm_coulomb; }}}, Dimension::worm_torque},
    {"worm_viscous", 1e-5, 3e-5, 9e-5, false, false,
     [](Drive& d, double s, Generator&) { d.bearings.worm_viscous = s; },
     {{"coefficient", [](const Drive& d) { return d.bearings.worm_viscous; }}}, Dimension::worm_viscous},
    {"bearing_asymmetry", 1e-5, 3e-5, 9e-5, true, false,
     [](Drive& d, double s, Generator&) { d.bearings.asymmetry_viscous = s; },
     {{"coefficient", [](const Drive& d) { return d.bearings.asymmetry_viscous; }}}, Dimension::worm_viscous},
    {"gear_coulomb", 0.015, 0.045, 0.15, false, false,
     [](Drive& d, double s, Generator&) { d.bearings.gear_coulomb = s; },
     {{"torque", [](const Drive& d) { return d.bearings.gear_coulomb; }}}, Dimension::gear_torque},
    {"gear_viscous", 0.01, 0.03, 0.09, false, false,
     [](Drive& d, double s, Generator&) { d.bearings.gear_viscous = s; },
     {{"coefficient", [](const Drive& d) { return d.bearings.gear_viscous; }}}, Dimension::gear_viscous},
    {"worm_inertia", 1e-6, 3e-6, 1e-5, true, false,
     [](Drive& d, double s, Generator&) { d.worm_inertia_excess += s; },
     {{"inertia", [](const Drive& d) { return d.geometry.worm_inertia + d.worm_inertia_excess - d.sheet.geometry.worm_inertia; }}}, Dimension::worm_inertia},
    {"gear_inertia", 4e-4, 1.2e-3, 4e-3, true, false,
     [](Drive& d, double s, Generator&) { d.gear_inertia_excess += s; },
     {{"inertia", [](const Drive& d) {
         const Geometry &g = d.geometry, &stated = d.sheet.geometry;
         return g.gear_inertia + d.gear_inertia_excess - stated.gear_inertia + (g.mass - stated.mass) * stated.arm * stated.arm;
       }}}, Dimension::gear_inertia},
    {"torque_gain", 0.01, 0.03, 0.1, true, false,
     [](Drive& d, double s, Generator&) { d.actuator.gain += s; }, {{"share", [](const Drive& d) { return d.actuator.gain; }}}},
    {"torque_offset", 4e-4, 1.2e-3, 5e-3, true, false,
     [](Drive& d, double s, Generator&) { d.actuator.offset += s; }, {{"torque", [](const Drive& d) { return d.actuator.offset; }}}, Dimension::worm_torque},
    {"torque_saturation", 0.15, 0.12, 0.09, false, false,
     [](Drive& d, double s, Generator&) { d.actuator.limit = s; }, {{"limit", [](const Drive& d) { return d.actuator.limit; }}}, Dimension::worm_torque},
    {"actuator_delay", 5e-4, 1.5e-3, 5e-3, false, false,
     [](Drive& d, double s, Generator&) { d.actuator.delay = s; }, {{"delay", [](const Drive& d) { return d.actuator.delay; }}},
     Dimension::plain, {"encoder_delay"}},
    {"actuator_lag", 5e-4, 1.5e-3, 5e-3, false, false,
     [](Drive& d, double s, Generator&) { d.actuator.lag = s; }, {{"time_constant", [](const Drive& d) { return d.actuator.lag; }}}},
    {"cogging", 6e-4, 1.8e-3, 6e-3, false, false,
     [](Drive& d, double s, Generator& g) {
       constexpr double counts[] = {1, 2, 3, 4, 6, 8};
       d.actuator.cogging = s;
       d.actuator.cogging_periods = counts[std::uniform_int_distribution<int>(0, 5)(g)];
       d.actuator.cogging_phase = between(g, 0, turn);
     },
     {{"amplitude", [](const Drive& d) { return d.actuator.cogging; }}, {"periods", [](const Drive& d) { return d.actuator.cogging_periods; }}}, Dimension::worm_torque},
    {"load_magnitude", 0.02, 0.06, 0.18, true, false,
     [](Drive& d, double s, Generator&) { d.load.excess += s; },
     {{"share", [](const Drive& d) { return (1.0 + d.load.excess) * d.geometry.mass / d.sheet.geometry.mass - 1.0; }}}},
    {"load_angle", 0.01, 0.03, 0.1, true, false,
     [](Drive& d, double s, Generator&) { d.load.angle += s; }, {{"angle", [](const Drive& d) { return d.load.angle; }}},
     Dimension::plain, {"encoder_offset"}},
    {"load_spring", 0.005, 0.015, 0.05, false, false,
     [](Drive& d, double s, Generator& g) { d.load.spring = s; d.load.spring_angle = between(g, -1, 1); },
     {{"stiffness", [](const Drive& d) { return d.load.spring; }}, {"angle", [](const Drive& d) { return d.load.spring_angle; }}}, Dimension::gear_torque},
    {"encoder_delay", 5e-4, 1.5e-3, 5e-3, false, false,
     [](Drive& d, double s, Generator&) { d.sensor.delay = s; }, {{"delay", [](const Drive& d) { return d.sensor.delay; }}},
     Dimension::plain, {"actuator_delay"}},
    {"encoder_scale", 0.003, 0.01, 0.03, true, false,
     [](Drive& d, double s, Generator&) { d.sensor.scale = s; }, {{"share", [](const Drive& d) { return d.sensor.scale; }}}},
    {"encoder_offset", 0.01, 0.03, 0.1, true, false,
     [](Drive& d, double s, Generator&) { d.sensor.offset = s; }, {{"angle", [](const Drive& d) { return d.sensor.offset; }}},
     Dimension::plain, {"load_angle"}},
    {"backlash", 3e-4, 1e-3, 4e-3, false, false,
     [](Drive& d, double s, Generator&) { d.teeth.gap = s; }, {{"gap", [](const Drive& d) { return d.teeth.gap; }}}},
    {"tooth_compliance", 1.5e-4, 4.5e-4, 1.5e-3, false, true,  // [rad/(N m)]
     [](Drive& d, double s, Generator&) { d.teeth.stiffness = 1.0 / (s * std::pow(normal_arm(d), 2)); },
     {{"stiffness", [](const Drive& d) { return d.teeth.stiffness; }}}, Dimension::gear_compliance},
    {"transmission_error", 2e-4, 6e-4, 2e-3, true, true,
     [](Drive& d, double s, Generator& g) { d.teeth.error = s; d.teeth.error_phase = between(g, 0, turn); },
     {{"amplitude", [](const Drive& d) { return std::abs(d.teeth.error); }}}}};

const std::vector<Secret> unknown{
    {"vibration", 2e-3, 4e-3, 8e-3, false, false,
     [](Drive& d, double s, Generator& g) { d.actuator.vibration = s; d.actuator.vibration_frequency = by_ratio(g, 5, 40); }, {}, Dimension::worm_torque},
    {"friction_spot", 0.1, 0.2, 0.4, true, false,
     [](Drive& d, double s, Generator& g) {
       d.friction.spot = s;
       d.friction.spot_angle = between(g, -2.0, 2.0);
       d.friction.spot_width = between(g, 0.1, 0.25);
     }, {}},
    {"mass_lost", 0.06, 0.12, 0.3, false, false,
     [](Drive& d, double s, Generator& g) { d.load.lost = s; d.load.lost_at = between(g, 8, 16); }, {}},
    {"fan", 0.003, 0.01, 0.03, false, false, [](Drive& d, double s, Generator&) { d.bearings.fan = s; }, {}, Dimension::gear_viscous},
    {"reversed_torque", 1, 1, 1, false, false, [](Drive& d, double, Generator&) { d.actuator.reversed = true; }, {}},
    {"dwell", 0.03, 0.06, 0.12, false, false,
     [](Drive& d, double s, Generator& g) { d.friction.dwell_rise = s; d.friction.dwell_time = by_ratio(g, 0.1, 1); }, {}, Dimension::friction}};
// clang-format on

}  // namespace

std::string_view name(Size size) {
  switch (size) {
    case Size::small: return "small";
    case Size::medium: return "medium";
    case Size::large: return "large";
  }
  return {};
}

double Secret::amount(Size size, const Sheet& sheet) const {
  const double usual = size == Size::small ? small : size == Size::medium ? medium : large;
  return usual * times_usual(dimension, sheet);
}

std::span<const Secret> catalogue() { return known; }
std::span<const Secret> outside() { return unknown; }

const Secret& secret(std::string_view effect) {
  for (const auto* list : {&known, &unknown})
    for (const Secret& one : *list)
      if (one.effect == effect) return one;
  throw std::invalid_argument("nothing called " + std::string(effect) + " can be hidden");
}

Drive any_drive(Generator& generator) {
  const auto times = [&](double low, double high) { return by_ratio(generator, low, high); };
  Sheet sheet;
  Geometry& g = sheet.geometry;
  g.ratio = std::round(times(8, 100));
  const double starts = g.ratio < 15 ? 4 : g.ratio < 30 ? 2 : 1, diameter_quotient = times(8, 14);
  g.lead_angle = std::atan(starts / diameter_quotient);
  sheet.friction = times(0.03, 0.25);
  const double size = times(0.3, 30);
  g.worm_radius *= std::pow(size, 0.2);  // inertias grow with the fifth power of lengths
  g.gear_radius = g.ratio * g.worm_radius * std::tan(g.lead_angle);
  g.worm_inertia *= size;
  // what the gear carries, against what the worm's inertia takes, its weight against its inertia, its mass on an arm
  const double inertia = times(0.1, 1.0) * g.worm_inertia * g.ratio / torque_ratio(g, sheet.friction);
  const double weight = times(1.0, 8.0) * inertia * usual_acceleration,
               on_arm = between(generator, 0.5, 0.95) * inertia;
  g.arm = on_arm * g.gravity / weight;
  g.mass = on_arm / (g.arm * g.arm);
  g.gear_inertia = inertia - on_arm;

  Drive drive;
  drive.sheet = sheet;
  drive.geometry = g;
  drive.friction.level = sheet.friction;
  drive.noise.white *= times_usual(Dimension::worm_torque, sheet);
  drive.sensor.counts = std::round(times(4096, 65536));
  // teeth as hard as the usual ones beside what they move
  const auto stiffness = [](const Drive& d) {
    const Geometry& of = d.geometry;
    const double on_gear = of.gear_inertia + of.mass * of.arm * of.arm, of_worm = of.worm_inertia * of.ratio * of.ratio;
    return 1.0 / ((1.0 / on_gear + 1.0 / of_worm) * std::pow(normal_arm(d), 2));
  };
  drive.teeth.stiffness *= stiffness(drive) / stiffness({});
  return drive;
}

void disturb_nominal(Drive& drive, const NominalErrors& errors, Generator& generator) {
  std::normal_distribution<double> normal;
  const auto off = [&] { return 1.0 + errors.share * normal(generator); };
  drive.friction.level *= off();
  drive.geometry.mass *= off();
  drive.geometry.worm_inertia *= off();
  drive.geometry.gear_inertia *= off();
  drive.actuator.gain += errors.share * normal(generator);
  drive.actuator.offset += errors.offset * normal(generator);
  drive.load.angle += errors.angle * normal(generator);
}

}  // namespace truth
