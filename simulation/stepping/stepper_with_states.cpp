#include "description/build.hpp"
#include "simulation/stepping/drive_stepper.hpp"

namespace wormdrive {

std::unique_ptr<SteppedDrive> make_stepper_with_states(const Scenario& scenario) {
  return stepper_of(make_drive<true>(scenario), scenario, false);
}

}  // namespace wormdrive
