#include "core/elastic/elastic_teeth.hpp"
#include "description/build.hpp"
#include "simulation/stepping/drive_stepper.hpp"

namespace wormdrive {

std::unique_ptr<SteppedDrive> make_compliant_stepper(const Scenario& scenario) {
  return stepper_of(CompliantDrive(make_drive(scenario), tooth_contact(scenario.effects)), scenario, false);
}

}  // namespace wormdrive
