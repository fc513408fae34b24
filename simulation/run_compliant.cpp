#include "core/elastic/elastic_teeth.hpp"
#include "simulation/run_drive.hpp"

namespace wormdrive {

RunSummary run_compliant(const Scenario& scenario, const RunListeners& listeners) {
  CompliantDrive drive(make_drive(scenario), tooth_contact(scenario.effects));
  return run_drive(drive, scenario, listeners);
}

}  // namespace wormdrive
