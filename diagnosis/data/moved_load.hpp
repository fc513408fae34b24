#pragma once
#include "description/build.hpp"
#include "diagnosis/data/recording.hpp"

namespace wormdrive {

/// The load that a recording moved: its own, or the scenario's.
inline const LoadParameters& moved_load(const Scenario& scenario, const Recording& recording) {
  return recording.load ? *recording.load : scenario.load;
}

/// The drive of a scenario with the load that a recording moved.
inline auto loaded_drive(const Scenario& scenario, const Recording& recording) {
  return make_drive(scenario, sum_of(moved_load(scenario, recording)), scenario.effects, scenario.motor);
}

}  // namespace wormdrive
