#include "simulation/run_scenario.hpp"

#include "core/elastic/elastic_teeth.hpp"
#include "simulation/run_drive.hpp"

namespace wormdrive {

RunSummary run_scenario(const Scenario& scenario, const RunListeners& listeners) {
  if (has_elastic_teeth(scenario.effects)) return run_compliant(scenario, listeners);
  if (scenario.effects.have_states()) return run_with_states(scenario, listeners);
  return with_drive_for_runs(scenario, [&](auto& drive) { return run_drive(drive, scenario, listeners); });
}

Trajectory simulate_scenario(const Scenario& scenario) {
  Trajectory whole;
  run_scenario(scenario, {.rows = [&](const Trajectory& part) {
                 whole.rows.insert(whole.rows.end(), part.rows.begin(), part.rows.end());
                 whole.events.insert(whole.events.end(), part.events.begin(), part.events.end());
               }});
  return whole;
}

}  // namespace wormdrive
