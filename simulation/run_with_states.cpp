#include "simulation/run_drive.hpp"

namespace wormdrive {

RunSummary run_with_states(const Scenario& scenario, const RunListeners& listeners) {
  auto drive = make_drive<true>(scenario);
  return run_drive(drive, scenario, listeners);
}

}  // namespace wormdrive
