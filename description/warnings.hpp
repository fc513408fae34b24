#pragma once
#include <string>
#include <vector>

#include "description/scenario.hpp"

namespace wormdrive {

/// Where a motor torque comes from: the scenario, or a command that seeks it, whatever the scenario says.
enum class MotorTorque { stated, sought };

/// What a user should know about his scenario before he trusts it, one sentence each.
std::vector<std::string> warnings(const Scenario& scenario, MotorTorque torque = MotorTorque::stated);

}  // namespace wormdrive
