#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "core/effect_list.hpp"

namespace wormdrive {

/// The state by which the predictor met each sample, for maps and predictions further ahead.
struct FilteredStates {
  std::vector<double> angle, speed, torque;    ///< of the gear [rad, rad/s]; the coloured torque [N m]
  std::vector<double> worm_angle, worm_speed;  ///< counted at the gear, divided by the ratio [rad, rad/s]
  std::vector<std::array<double, effect_state_count>> of_effects;  ///< empty where these have no states

  explicit FilteredStates(std::size_t samples = 0)
      : angle(samples), speed(samples), torque(samples), worm_angle(samples), worm_speed(samples) {}
};

}  // namespace wormdrive
