#include "diagnosis/candidates/tolerances.hpp"

#include <algorithm>
#include <stdexcept>

namespace wormdrive {

std::vector<Coordinate> toleranced_coordinates(const Scenario& scenario, const Magnitudes& m,
                                               const std::vector<Tolerance>& stated) {
  const Tolerances by_scenario = scenario.tolerance.value_or(Tolerances{});
  std::vector<Coordinate> all;
  const auto add = [&](std::string_view effect, std::string_view field, double tolerance, double scale, double low,
                       double high) {
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
                   .tolerance = tolerance});
  };
  if (m.has_teeth) {
    add("mesh_friction", "change", by_scenario.friction * m.friction, 0.04 * m.friction, -0.7 * m.friction, 0.6);
    all.back().blurred_by = "stribeck";
    all.back().blurred_by_field = "drop";
  }
  if (m.load_torque > 0.0) {
    add("load_magnitude", "share", by_scenario.load, 0.03, -0.8, 2.0);
    if (m.load_turns) add("load_angle", "angle", by_scenario.load_angle, 0.03, -0.7, 0.7);
  }
  add("torque_gain", "share", by_scenario.torque_gain, 0.02, -0.5, 0.5);
  add("torque_offset", "torque", by_scenario.torque_offset.value_or(0.01 * m.torque), 0.03 * m.torque,
      -m.largest_torque, m.largest_torque);
  if (m.has_teeth)
    add("gear_inertia", "inertia", by_scenario.gear_inertia * m.gear_inertia, 0.1 * m.gear_inertia,
        -0.8 * m.gear_inertia, 3.0 * m.gear_inertia);
  add("worm_inertia", "inertia", by_scenario.worm_inertia * m.worm_inertia, 0.02 * m.worm_inertia,
      -0.5 * m.worm_inertia, 1.0 * m.worm_inertia);
  // an inertia seems the smaller the faster the motion
  for (Coordinate& c : all)
    if (c.effect == GearInertia<double>::id || c.effect == WormInertia<double>::id) c.model_error = {.of_scale = 0.02};
  for (const Tolerance& t : stated) (void)field_of(scenario.effects, t.effect, t.field);
  return all;
}

}  // namespace wormdrive
