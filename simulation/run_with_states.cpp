#include "simulation/run_drive.hpp"

namespace wormdrive {

RunSummary run_with_states(const Scenario& scenario, const RunListeners& listeners) {
  return with_drive<true>(scenario, [&](auto& drive) { return run_drive(drive, scenario, listeners); });
}

}  // namespace wormdrive
