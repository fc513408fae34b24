#include "diagnosis/points/steady_points.hpp"

#include <cmath>
#include <memory>

#include "core/steady.hpp"
#include "description/build.hpp"

namespace wormdrive {

TorquePoints steady_points(const std::vector<SpeedTorqueRecord>& records, const Scenario& scenario) {
  TorquePoints points;
  double sum = 0.0;
  for (const SpeedTorqueRecord& record : records) sum += record.motor_torque * record.motor_torque;
  const double rms = std::sqrt(sum / static_cast<double>(records.size()));
  auto at_rest = make_drive(scenario);
  at_rest.enter(0.0);
  const double load = at_rest.inputs(at_rest.moment(0.0, scenario.initial.theta_g, 0.0), Motion::stuck).gear;
  for (const SpeedTorqueRecord& record : records) {
    points.names.push_back(record.name);
    points.worm_speed.push_back(record.worm_speed);
    points.load_torque.push_back(load);
    points.direction.push_back(record.worm_speed > 0.0 ? 1 : -1);
    points.torque.push_back(record.motor_torque);
    points.deviation.push_back(rms);
  }
  points.half = every_second(points.direction, points.worm_speed);
  points.predict = [scenario = std::make_shared<const Scenario>(scenario),
                    speeds = points.worm_speed](const Effects<double>& effects) {
    auto drive = make_drive(*scenario, effects, Signal{});
    drive.enter(0.0);
    std::vector<double> torques;
    for (const double speed : speeds) torques.push_back(steady_torque(drive, speed, scenario->initial.theta_g, 0.0));
    return torques;
  };
  return points;
}

TorquePoints steady_points_at_two_loads(const std::vector<SpeedTorqueRecord>& records, const Scenario& scenario,
                                        double load) {
  Scenario other = scenario;
  other.load = Signal{{Constant{load}}};
  TorquePoints points = steady_points(records, scenario);
  const TorquePoints more = steady_points(records, other);
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(points.names, more.names);
  append(points.worm_speed, more.worm_speed);
  append(points.load_torque, more.load_torque);
  append(points.direction, more.direction);
  append(points.torque, more.torque);
  append(points.deviation, more.deviation);
  append(points.half, more.half);
  points.predict = [append, first = points.predict, second = more.predict](const Effects<double>& effects) {
    std::vector<double> torques = first(effects);
    append(torques, second(effects));
    return torques;
  };
  return points;
}

}  // namespace wormdrive
