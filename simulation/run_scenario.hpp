#pragma once
#include <array>
#include <functional>
#include <numeric>
#include <optional>
#include <vector>

#include "control/control_summary.hpp"
#include "description/scenario.hpp"
#include "events/audit.hpp"
#include "output/trajectory.hpp"

namespace wormdrive {

/// Who wants to see a run while it goes on; any may be empty.
struct RunListeners {
  std::function<void(Trajectory)> rows{};                            ///< takes rows and events in portions, in order
  std::function<void(const std::vector<ControlRecord>&)> samples{};  ///< takes the controller's samples likewise
  std::function<void(double)> time{};  ///< called with the simulated time [s] at every row
  bool audit = false;                  ///< re-integrate and re-scan the run afterwards
};

/// What a run amounts to.
struct RunSummary {
  SolverStatistics statistics;
  std::array<long, event_kind_count> events{};  ///< by EventKind
  Observation end{};
  std::optional<AuditReport> audit;
  std::optional<ControlSummary> control;

  long total_events() const { return std::accumulate(events.begin(), events.end(), 0L); }
};

/// Simulates a scenario with the solver that it names. Throws SimulationFailure if it cannot go on, after handing over
/// what there is.
RunSummary run_scenario(const Scenario& scenario, const RunListeners& listeners = {});

/// The whole run in memory.
Trajectory simulate_scenario(const Scenario& scenario);

}  // namespace wormdrive
