#pragma once
#include "diagnosis/data/speed_torque_records.hpp"
#include "diagnosis/points/torque_points.hpp"

namespace wormdrive {

/// Records at constant speed as torque points of a scenario's drive, all of equal weight; every second of the speeds,
/// sorted by sign and size, is in one half.
TorquePoints steady_points(const std::vector<SpeedTorqueRecord>& records, const Scenario& scenario);

/// The same under the scenario's load and another one [N m]; for what could be seen then, not for what was.
TorquePoints steady_points_at_two_loads(const std::vector<SpeedTorqueRecord>& records, const Scenario& scenario,
                                        double load);

}  // namespace wormdrive
