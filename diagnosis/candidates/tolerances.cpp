#include "diagnosis/candidates/tolerances.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>

namespace wormdrive {

std::vector<Coordinate> toleranced_coordinates(const Scenario& scenario, const Magnitudes& m,
                                               const std::vector<Tolerance>& stated) {
  const Tolerances by_scenario = scenario.tolerance.value_or(Tolerances{});
  std::vector<Coordinate> all;
  // What is stated may be another quantity or unit: a load's inertia that was forgotten, a current for a torque. Beyond
  // a factor of thirty to either side reading a recording rejects it.
  constexpr double all_but_nothing = 1.0 - 1.0 / 30.0, decades = 30.0 - 1.0;
  constexpr double turn = 2.0 * std::numbers::pi;  // no angle of an arm lies at a bound
  const auto add = [&](std::string_view effect, std::string_view field, double tolerance, double scale, double low,
                       double high, double whole) {
    for (const Tolerance& t : stated)
      if (t.effect == effect && t.field == field) tolerance = t.deviation;
    // two encoders see more than the equations of friction and load are worth
    constexpr double least_share = 0.03;
    if (m.has_worm_encoder) tolerance = std::max(tolerance, least_share * scale);
    const double centre = field_of(scenario.effects, effect, field).value;
    all.push_back({.effect = effect,
                   .field = field,
                   .scale = scale,
                   .low = centre + low,
                   .high = centre + high,
                   .centre = centre,
                   .whole = whole,
                   .tolerance = tolerance});
  };
  if (m.has_teeth) {
    add("mesh_friction", "change", by_scenario.friction * m.stated_friction, 0.04 * m.friction,
        -all_but_nothing * m.stated_friction, 0.6, m.friction);
    all.back().blurred_by = "stribeck";
    all.back().blurred_by_field = "drop";
  }
  if (m.load_torque > 0.0) {
    add("load_magnitude", "share", by_scenario.load, 0.03, -all_but_nothing, decades, 1.0);
    if (m.load_turns) {
      add("load_angle", "angle", by_scenario.load_angle, 0.03, -turn, turn, 0.0);
      all.back().turns = true;
    }
  }
  add("torque_gain", "share", by_scenario.torque_gain, 0.02, -all_but_nothing, decades, 1.0);
  add("torque_offset", "torque", by_scenario.torque_offset.value_or(0.01 * m.torque), 0.03 * m.torque,
      -m.largest_torque, m.largest_torque, 0.0);
  if (m.has_teeth)
    add("gear_inertia", "inertia", by_scenario.gear_inertia * m.gear_inertia, 0.1 * m.gear_inertia,
        -all_but_nothing * m.gear_inertia, decades * m.gear_inertia, m.gear_inertia);
  add("worm_inertia", "inertia", by_scenario.worm_inertia * m.worm_inertia, 0.02 * m.worm_inertia,
      -all_but_nothing * m.worm_inertia, decades * m.worm_inertia, m.worm_inertia);
  // an inertia seems the smaller the faster the motion
  for (Coordinate& c : all)
    if (c.effect == GearInertia<double>::id || c.effect == WormInertia<double>::id) c.model_error = {.of_scale = 0.02};
  for (const Tolerance& t : stated) (void)field_of(scenario.effects, t.effect, t.field);
  return all;
}

}  // namespace wormdrive
