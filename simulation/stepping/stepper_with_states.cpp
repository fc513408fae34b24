#include "description/build.hpp"
#include "simulation/stepping/drive_stepper.hpp"

namespace wormdrive {

std::unique_ptr<SteppedDrive> make_stepper_with_states(const Scenario& scenario) {
  return with_drive<true>(scenario, [&](auto& drive) { return stepper_of(std::move(drive), scenario, false); });
}

}  // namespace wormdrive
