#include "diagnosis/points/break_in_points.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "core/steady.hpp"
#include "description/build.hpp"
#include "description/diagnostics.hpp"
#include "diagnosis/data/recorded_table.hpp"
#include "diagnosis/rules/points.hpp"
#include "statistics/student_t.hpp"

namespace wormdrive {
namespace {

/// A scenario whose load takes these values one after another, from t = k on the k-th: so one drive serves all.
Scenario under_loads(Scenario scenario, const std::vector<double>& loads) {
  Samples samples;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    samples.times.push_back(static_cast<double>(k));
    samples.values.push_back(loads[k]);
  }
  samples.interpolation = Interpolation::hold;
  scenario.load = Signal{{samples}};
  return scenario;
}

/// Torques at break-in in these directions, one for every load.
std::vector<double> torques_at(const Scenario& scenario, const Effects<double>& effects,
                               const std::vector<int>& direction) {
  auto drive = make_drive(scenario, effects, Signal{});
  std::vector<double> torques;
  for (std::size_t k = 0; k < direction.size(); ++k) {
    const double t = static_cast<double>(k) + 0.5;
    drive.enter(t);
    torques.push_back(
        break_in_torque(drive, direction[k] > 0 ? Motion::forward : Motion::backward, scenario.initial.theta_g, t));
  }
  return torques;
}

/// A slope through the origin with its standard error, by Student's t about points whose deviation grows with them.
Estimate slope(const std::string& name, const std::vector<double>& load, const std::vector<double>& torque) {
  std::vector<double> ratios;
  for (std::size_t k = 0; k < load.size(); ++k) ratios.push_back(-torque[k] / load[k]);
  std::vector<double> sorted = ratios;
  std::sort(sorted.begin(), sorted.end());
  double centre = sorted[sorted.size() / 2], scale = std::abs(centre), weights = 0.0;
  constexpr StudentT student;
  for (int round = 0; round < 100; ++round) {
    std::vector<double> errors;
    for (const double ratio : ratios) errors.push_back(ratio - centre);
    scale = student.scale(errors, scale, 1e-9 * std::abs(centre));
    double sum = 0.0;
    weights = 0.0;
    for (std::size_t k = 0; k < ratios.size(); ++k) {
      const double w = student.weight(errors[k], scale);
      weights += w;
      sum += w * ratios[k];
    }
    centre = sum / weights;
  }
  const double error = scale / std::sqrt(student.information() * static_cast<double>(ratios.size()));
  const double half = t_quantile(ratios.size() - 1) * error;
  return {name, unit::none, centre, error, centre - half, centre + half};
}

}  // namespace

std::vector<BreakIn> read_break_in_table(const std::string& path, const Scenario& scenario) {
  const DataTable file = read_data_table(path);
  const RecordedValues loads = recorded_values(file, "load_torque", scenario, true),
                       motors = recorded_values(file, "motor_torque", scenario, true);
  require_equal_lengths(file, loads.name, loads.values.size(), motors.name, motors.values.size());
  const std::vector<double>&load = loads.values, &motor = motors.values;
  if (load.size() < rules::points::fewest)
    reject({path}, fmt::format("{} break-in torques; at least {} are needed, in both directions", load.size(),
                               rules::points::fewest));
  std::vector<BreakIn> table;
  for (std::size_t k = 0; k < load.size(); ++k) table.push_back({load[k], motor[k]});
  return table;
}

TorquePoints break_in_points(const std::vector<BreakIn>& table, const Scenario& scenario) {
  TorquePoints points;
  for (const BreakIn& row : table) points.load_torque.push_back(row.load_torque);
  const Scenario loaded = under_loads(scenario, points.load_torque);
  const std::vector<double> forward = torques_at(loaded, scenario.effects, std::vector<int>(table.size(), 1)),
                            backward = torques_at(loaded, scenario.effects, std::vector<int>(table.size(), -1));
  for (std::size_t k = 0; k < table.size(); ++k) {
    const double torque = table[k].motor_torque;
    const bool ahead = std::abs(torque - forward[k]) < std::abs(torque - backward[k]);
    points.names.push_back(ahead ? "forward" : "backward");
    points.worm_speed.push_back(0.0);
    points.direction.push_back(ahead ? 1 : -1);
    points.torque.push_back(torque);
    points.deviation.push_back(std::abs(torque));
  }
  double largest = 0.0;
  for (const double deviation : points.deviation) largest = std::max(largest, deviation);
  for (double& deviation : points.deviation) deviation = std::max(deviation, 0.01 * largest);
  points.half = every_second(points.direction, points.load_torque);
  points.predict = [scenario = std::make_shared<const Scenario>(loaded), direction = points.direction](
                       const Effects<double>& effects) { return torques_at(*scenario, effects, direction); };
  return points;
}

std::vector<Estimate> identified_constants(const TorquePoints& points, const Scenario& scenario) {
  std::vector<Estimate> constants;
  const GearMesh<double> mesh = stated_mesh(scenario);
  if (!mesh.has_teeth) return constants;
  double weights = 0.0, sum = 0.0;
  for (const int product : {1, -1}) {  // friction helps the worm, or hinders it
    std::vector<double> load, torque;
    for (std::size_t k = 0; k < points.size(); ++k)
      if (points.direction[k] * points.load_torque[k] * product > 0.0) {
        load.push_back(points.load_torque[k]);
        torque.push_back(points.torque[k]);
      }
    if (load.size() < 2) continue;
    constants.push_back(slope(product > 0 ? "C1" : "C2", load, torque));
    // C(m) = r (a - m c)/(b + m s) turned round
    const double C = constants.back().value, step = 1e-6;
    const auto friction = [&](double c) {
      double m = product * mesh.mu;
      for (int k = 0; k < 50; ++k) m -= (mesh.C(m) - c) / ((mesh.C(m + step) - mesh.C(m - step)) / (2.0 * step));
      return product * m;
    };
    const double change = std::abs(friction(C + constants.back().standard_error) - friction(C));
    const double weight = change > 0.0 ? 1.0 / (change * change) : 1e30;
    weights += weight;
    sum += weight * friction(C);
  }
  if (weights > 0.0) {
    const double error = 1.0 / std::sqrt(weights), half = t_quantile(points.size() - 1) * error;
    constants.push_back({"mu_s", unit::none, sum / weights, error, sum / weights - half, sum / weights + half});
  }
  return constants;
}

}  // namespace wormdrive
