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

const Geometry sheet;

// clang-format off
const std::vector<Secret> known{
    {"mesh_friction", 0.005, 0.015, 0.045, true, false,
     [](Drive& d, double s, Generator&) { d.friction.level += s; },
     {{"change", [](const Drive& d) { return d.friction.level - MeshFriction{}.level; }}}},
    {"stribeck", 0.01, 0.03, 0.09, true, false,
     [](Drive& d, double s, Generator& g) {
       d.friction.drop = s;
       d.friction.fall_speed = by_ratio(g, 0.06, 0.4);
       using enum MeshFriction::Fall;
       const double law = between(g, 0, 3);
       d.friction.fall = law < 1.0 ? gaussian : law < 2.0 ? lorentzian : hyperbolic;
     },
     {{"drop", [](const Drive& d) { return d.friction.drop; }}}},
    {"friction_asymmetry", 0.004, 0.012, 0.036, true, false,
     [](Drive& d, double s, Generator&) { d.friction.asymmetry = s; },
     {{"change", [](const Drive& d) { return d.friction.asymmetry; }}}},
    {"position_friction", 0.02, 0.06, 0.18, true, false,
     [](Drive& d, double s, Generator& g) { d.friction.wave = s; d.friction.wave_phase = between(g, 0, turn); },
     {{"amplitude", [](const Drive& d) { return std::abs(d.friction.wave); }}}},
    {"thread_friction", 0.02, 0.06, 0.18, true, false,
     [](Drive& d, double s, Generator& g) { d.friction.worm_wave = s; d.friction.worm_wave_phase = between(g, 0, turn); },
     {{"amplitude", [](const Drive& d) { return std::abs(d.friction.worm_wave); }}}},
    {"friction_drift", 0.03, 0.09, 0.27, true, false,
     [](Drive& d, double s, Generator&) { d.friction.drift = s; }, {{"share", [](const Drive& d) { return d.friction.drift; }}}},
    {"static_friction", 0.01, 0.03, 0.09, false, false,
     [](Drive& d, double s, Generator&) { d.friction.rise = s; }, {{"rise", [](const Drive& d) { return d.friction.rise; }}}},
    {"worm_coulomb", 1e-3, 3e-3, 1e-2, false, false,
     [](Drive& d, double s, Generator&) { d.bearings.worm_coulomb = s; },
     {{"torque", [](const Drive& d) { return d.bearings.worm_coulomb; }}}},
    {"worm_viscous", 1e-5, 3e-5, 9e-5, false, false,
     [](Drive& d, double s, Generator&) { d.bearings.worm_viscous = s; },
     {{"coefficient", [](const Drive& d) { return d.bearings.worm_viscous; }}}},
    {"bearing_asymmetry", 1e-5, 3e-5, 9e-5, true, false,
     [](Drive& d, double s, Generator&) { d.bearings.asymmetry_viscous = s; },
     {{"coefficient", [](const Drive& d) { return d.bearings.asymmetry_viscous; }}}},
    {"gear_coulomb", 0.015, 0.045, 0.15, false, false,
     [](Drive& d, double s, Generator&) { d.bearings.gear_coulomb = s; },
     {{"torque", [](const Drive& d) { return d.bearings.gear_coulomb; }}}},
    {"gear_viscous", 0.01, 0.03, 0.09, false, false,
     [](Drive& d, double s, Generator&) { d.bearings.gear_viscous = s; },
     {{"coefficient", [](const Drive& d) { return d.bearings.gear_viscous; }}}},
    {"worm_inertia", 1e-6, 3e-6, 1e-5, true, false,
     [](Drive& d, double s, Generator&) { d.worm_inertia_excess += s; },
     {{"inertia", [](const Drive& d) { return d.geometry.worm_inertia + d.worm_inertia_excess - sheet.worm_inertia; }}}},
    {"gear_inertia", 4e-4, 1.2e-3, 4e-3, true, false,
     [](Drive& d, double s, Generator&) { d.gear_inertia_excess += s; },
     {{"inertia", [](const Drive& d) {
         return d.geometry.gear_inertia + d.gear_inertia_excess - sheet.gear_inertia +
                (d.geometry.mass - sheet.mass) * sheet.arm * sheet.arm;
       }}}},
    {"torque_gain", 0.01, 0.03, 0.1, true, false,
     [](Drive& d, double s, Generator&) { d.actuator.gain += s; }, {{"share", [](const Drive& d) { return d.actuator.gain; }}}},
    {"torque_offset", 4e-4, 1.2e-3, 5e-3, true, false,
     [](Drive& d, double s, Generator&) { d.actuator.offset += s; }, {{"torque", [](const Drive& d) { return d.actuator.offset; }}}},
    {"torque_saturation", 0.15, 0.12, 0.09, false, false,
     [](Drive& d, double s, Generator&) { d.actuator.limit = s; }, {{"limit", [](const Drive& d) { return d.actuator.limit; }}}},
    {"actuator_delay", 5e-4, 1.5e-3, 5e-3, false, false,
     [](Drive& d, double s, Generator&) { d.actuator.delay = s; }, {{"delay", [](const Drive& d) { return d.actuator.delay; }}},
     {"encoder_delay"}},
    {"actuator_lag", 5e-4, 1.5e-3, 5e-3, false, false,
     [](Drive& d, double s, Generator&) { d.actuator.lag = s; }, {{"time_constant", [](const Drive& d) { return d.actuator.lag; }}}},
    {"cogging", 6e-4, 1.8e-3, 6e-3, false, false,
     [](Drive& d, double s, Generator& g) {
       constexpr double counts[] = {1, 2, 3, 4, 6, 8};
       d.actuator.cogging = s;
       d.actuator.cogging_periods = counts[std::uniform_int_distribution<int>(0, 5)(g)];
       d.actuator.cogging_phase = between(g, 0, turn);
     },
     {{"amplitude", [](const Drive& d) { return d.actuator.cogging; }}, {"periods", [](const Drive& d) { return d.actuator.cogging_periods; }}}},
    {"load_magnitude", 0.02, 0.06, 0.18, true, false,
     [](Drive& d, double s, Generator&) { d.load.excess += s; },
     {{"share", [](const Drive& d) { return (1.0 + d.load.excess) * d.geometry.mass / sheet.mass - 1.0; }}}},
    {"load_angle", 0.01, 0.03, 0.1, true, false,
     [](Drive& d, double s, Generator&) { d.load.angle += s; }, {{"angle", [](const Drive& d) { return d.load.angle; }}},
     {"encoder_offset"}},
    {"load_spring", 0.005, 0.015, 0.05, false, false,
     [](Drive& d, double s, Generator& g) { d.load.spring = s; d.load.spring_angle = between(g, -1, 1); },
     {{"stiffness", [](const Drive& d) { return d.load.spring; }}, {"angle", [](const Drive& d) { return d.load.spring_angle; }}}},
    {"encoder_delay", 5e-4, 1.5e-3, 5e-3, false, false,
     [](Drive& d, double s, Generator&) { d.sensor.delay = s; }, {{"delay", [](const Drive& d) { return d.sensor.delay; }}},
     {"actuator_delay"}},
    {"encoder_scale", 0.003, 0.01, 0.03, true, false,
     [](Drive& d, double s, Generator&) { d.sensor.scale = s; }, {{"share", [](const Drive& d) { return d.sensor.scale; }}}},
    {"encoder_offset", 0.01, 0.03, 0.1, true, false,
     [](Drive& d, double s, Generator&) { d.sensor.offset = s; }, {{"angle", [](const Drive& d) { return d.sensor.offset; }}},
     {"load_angle"}},
    {"backlash", 3e-4, 1e-3, 4e-3, false, false,
     [](Drive& d, double s, Generator&) { d.teeth.gap = s; }, {{"gap", [](const Drive& d) { return d.teeth.gap; }}}},
    {"tooth_compliance", 1.5e-4, 4.5e-4, 1.5e-3, false, true,  // [rad/(N m)]
     [](Drive& d, double s, Generator&) { d.teeth.stiffness = 1.0 / (s * std::pow(normal_arm(d), 2)); },
     {{"stiffness", [](const Drive& d) { return d.teeth.stiffness; }}}},
    {"transmission_error", 2e-4, 6e-4, 2e-3, true, true,
     [](Drive& d, double s, Generator& g) { d.teeth.error = s; d.teeth.error_phase = between(g, 0, turn); },
     {{"amplitude", [](const Drive& d) { return std::abs(d.teeth.error); }}}}};

const std::vector<Secret> unknown{
    {"vibration", 2e-3, 4e-3, 8e-3, false, false,
     [](Drive& d, double s, Generator& g) { d.actuator.vibration = s; d.actuator.vibration_frequency = by_ratio(g, 5, 40); }, {}},
    {"friction_spot", 0.1, 0.2, 0.4, true, false,
     [](Drive& d, double s, Generator& g) {
       d.friction.spot = s;
       d.friction.spot_angle = between(g, -2.0, 2.0);
       d.friction.spot_width = between(g, 0.1, 0.25);
     }, {}},
    {"mass_lost", 0.06, 0.12, 0.3, false, false,
     [](Drive& d, double s, Generator& g) { d.load.lost = s; d.load.lost_at = between(g, 8, 16); }, {}},
    {"fan", 0.003, 0.01, 0.03, false, false, [](Drive& d, double s, Generator&) { d.bearings.fan = s; }, {}},
    {"reversed_torque", 1, 1, 1, false, false, [](Drive& d, double, Generator&) { d.actuator.reversed = true; }, {}},
    {"dwell", 0.03, 0.06, 0.12, false, false,
     [](Drive& d, double s, Generator& g) { d.friction.dwell_rise = s; d.friction.dwell_time = by_ratio(g, 0.1, 1); }, {}}};
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

double Secret::amount(Size size) const { return size == Size::small ? small : size == Size::medium ? medium : large; }

std::span<const Secret> catalogue() { return known; }
std::span<const Secret> outside() { return unknown; }

const Secret& secret(std::string_view effect) {
  for (const auto* list : {&known, &unknown})
    for (const Secret& one : *list)
      if (one.effect == effect) return one;
  throw std::invalid_argument("nothing called " + std::string(effect) + " can be hidden");
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
