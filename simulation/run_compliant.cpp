#include "core/elastic/elastic_teeth.hpp"
#include "simulation/run_drive.hpp"

namespace wormdrive {

RunSummary run_compliant(const Scenario& scenario, const RunListeners& listeners) {
  return with_drive(scenario, [&](auto& rigid) {
    CompliantDrive compliant(std::move(rigid), tooth_contact(scenario.effects));
    return run_drive(compliant, scenario, listeners);
  });
}

}  // namespace wormdrive
