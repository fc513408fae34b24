#pragma once
#include <vector>

#include "description/scenario.hpp"

namespace wormdrive {

/// A drive at constant speed under a constant load torque.
struct OperatingPoint {
  double worm_speed;    ///< at an even pitch [rad/s]
  double load_torque;   ///< tau_l on the gear [N m]
  double motor_torque;  ///< commanded [N m]; not a number where no torque keeps the speed, or none within the motor's
                        ///< limit
  double motor_power;   ///< into the drive, from the supply on if there is a winding [W]
  double load_power;    ///< into the drive [W]
  double loss;          ///< [W]
  double efficiency;    ///< what comes out over what goes in; 0 where a load that drives returns nothing
};

/// The operating points of a scenario's drive at its initial angle and time 0, speed by speed, under loads in place of
/// its own. Speeds [rad/s] are not 0, loads in N m.
std::vector<OperatingPoint> efficiency_map(Scenario scenario, const std::vector<double>& worm_speeds,
                                           const std::vector<double>& load_torques);

}  // namespace wormdrive
