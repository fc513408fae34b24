#pragma once
#include <vector>

namespace wormdrive {

/// The state by which the predictor met each sample, for maps and predictions further ahead.
struct FilteredStates {
  std::vector<double> angle, speed, torque;  ///< [rad, rad/s, N m]; torque is the coloured one
};

}  // namespace wormdrive
