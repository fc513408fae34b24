#include "simulation/lanes/lane_run.hpp"

#include "simulation/lanes/lane_run_of.hpp"

namespace wormdrive {

std::unique_ptr<LaneRun> lane_run(const Scenario& scenario) {
  if (!fits_lane(scenario)) return nullptr;
  if (scenario.effects.have_states()) return lane_run_with_states(scenario);
  return std::visit(
      [&](const auto& load) {
        return lane_run_of(scenario, make_drive(scenario, load, scenario.effects, scenario.motor));
      },
      scenario.load);
}

}  // namespace wormdrive
