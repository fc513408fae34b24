#pragma once
#include <functional>
#include <string>
#include <vector>

#include "description/scenario.hpp"

namespace wormdrive {

/// Measured torques, each at conditions of its own, and what a scenario gives there: records at constant speed, or
/// torques at break-in.
struct TorquePoints {
  std::vector<std::string> names;
  std::vector<double> worm_speed;   ///< [rad/s]; of a break-in 0
  std::vector<double> load_torque;  ///< [N m]
  std::vector<int> direction;       ///< +1 forward, -1 backward
  std::vector<double> torque;       ///< as measured [N m]
  std::vector<double> deviation;    ///< expected of a point, up to a common factor [N m]
  std::vector<int> half;            ///< 0 or 1: fits on one half are judged on the other, both ways
  /// Torques of the drive with these effects at all points [N m]; empty where it has none.
  std::function<std::vector<double>(const Effects<double>&)> predict;

  std::size_t size() const { return torque.size(); }
};

/// Halves for points that are sorted by direction, then by the size of a quantity: every second one.
std::vector<int> every_second(const std::vector<int>& direction, const std::vector<double>& size);

}  // namespace wormdrive
