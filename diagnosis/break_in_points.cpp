#include "diagnosis/break_in_points.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "core/steady.hpp"
#include "diagnosis/student_t.hpp"
#include "scenarios/build.hpp"
#include "scenarios/csv.hpp"
#include "scenarios/faults.hpp"

namespace wormdrive {
namespace {

constexpr std::size_t fewest = 6;

/// Torque at break-in of a scenario's drive with other effects under a load of its own.
double torque_at(const Scenario& scenario, const Effects<double>& effects, double load, int direction) {
  Scenario at = scenario;
  at.load = Signal{{Constant{load}}};
  return with_drive(at, effects, Signal{}, [&](auto& drive) {
    drive.enter(0.0);
    return break_in_torque(drive, direction > 0 ? Motion::forward : Motion::backward, scenario.initial.theta_g, 0.0);
  });
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
  const Csv csv = read_csv(path);
  const std::vector<double> load = csv.numbers(column_name(scenario.columns, "load_torque_Nm"));
  const std::vector<double> motor = csv.numbers(column_name(scenario.columns, "motor_torque_Nm"));
  if (load.size() < fewest)
    refuse({path}, fmt::format("{} break-in torques; at least {} are needed, in both directions", load.size(), fewest));
  std::vector<BreakIn> table;
  for (std::size_t k = 0; k < load.size(); ++k) table.push_back({load[k], motor[k]});
  return table;
}

TorquePoints break_in_points(const std::vector<BreakIn>& table, const Scenario& scenario) {
  TorquePoints points;
  for (const BreakIn& row : table) {
    const double forward = torque_at(scenario, scenario.effects, row.load_torque, 1),
                 backward = torque_at(scenario, scenario.effects, row.load_torque, -1);
    const bool ahead = std::abs(row.motor_torque - forward) < std::abs(row.motor_torque - backward);
    points.names.push_back(ahead ? "forward" : "backward");
    points.worm_speed.push_back(0.0);
    points.load_torque.push_back(row.load_torque);
    points.direction.push_back(ahead ? 1 : -1);
    points.torque.push_back(row.motor_torque);
    points.deviation.push_back(std::abs(row.motor_torque));
  }
  double largest = 0.0;
  for (const double deviation : points.deviation) largest = std::max(largest, deviation);
  for (double& deviation : points.deviation) deviation = std::max(deviation, 0.01 * largest);
  points.half = every_second(points.direction, points.load_torque);
  points.predict = [scenario = std::make_shared<const Scenario>(scenario), load = points.load_torque,
                    direction = points.direction](const Effects<double>& with) {
    std::vector<double> torques;
    for (std::size_t k = 0; k < load.size(); ++k) torques.push_back(torque_at(*scenario, with, load[k], direction[k]));
    return torques;
  };
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
