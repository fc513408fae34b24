#include "simulation/lanes/lane_run_of.hpp"

namespace wormdrive {

std::unique_ptr<LaneRun> lane_run_with_states(const Scenario& scenario) {
  return lane_run_of(scenario, make_drive<true>(scenario));
}

}  // namespace wormdrive
