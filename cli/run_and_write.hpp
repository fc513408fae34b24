#pragma once
#include <string>

#include "cli/scenario_options.hpp"
#include "output/replacing.hpp"
#include "output/run_file.hpp"
#include "simulation/run_scenario.hpp"

namespace wormdrive {

struct RunOptions {
  ScenarioOptions scenario;
  std::string output;  ///< empty: named after the scenario
  bool audit = false;
  Replace replace = Replace::same_kind;
};

/// Runs a scenario into a result file, to its end; listeners may look on. Throws SimulationFailure or OutputFault.
RunSummary run_into(RunFile& file, const Scenario& scenario, RunListeners listeners);

/// Runs a scenario into a result file and tells what it comes to; listeners may look on. Throws SimulationFailure, the
/// part kept, or OutputFault.
RunSummary run_and_write(const Scenario& scenario, const std::string& output, const RunOptions& options,
                         RunListeners listeners = {});

}  // namespace wormdrive
