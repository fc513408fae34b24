#pragma once
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "events/simulation_failure.hpp"
#include "output/run_columns.hpp"
#include "simulation/run_scenario.hpp"

namespace wormdrive {

/// A run in memory with its scenario, complete or up to where it could not go on.
class RunResult {
 public:
  explicit RunResult(std::shared_ptr<const Scenario> scenario) : scenario_(std::move(scenario)) {}

  /// Simulates; time: called with the simulated time [s] at every row. A halt is noted, not thrown.
  void run(std::function<void(double)> time);

  const Scenario& scenario() const { return *scenario_; }
  const Trajectory& trajectory() const { return trajectory_; }
  const std::vector<ControlRecord>& samples() const { return samples_; }
  RunContents contents() const;
  /// Why the run could not go on, if it could not.
  const std::optional<std::string>& halted() const { return halted_; }
  /// How well the controller did, by the names of the result file; nothing without a controller.
  std::map<std::string, double> metrics() const;
  /// What the solver did, likewise.
  std::map<std::string, long> statistics() const;
  /// Writes the result file that `wormdrive run` would write. Throws OutputFault.
  void write(const std::string& path, const std::string& command_line, bool force) const;

 private:
  std::shared_ptr<const Scenario> scenario_;
  Trajectory trajectory_;
  std::vector<ControlRecord> samples_;
  RunSummary summary_;
  std::optional<std::string> halted_;
};

/// The values of one column.
template <class T, class Source>
std::vector<T> column(const RunColumn<Source>& of, const std::vector<Source>& rows) {
  std::vector<T> values;
  values.reserve(rows.size());
  for (const Source& row : rows) values.push_back(static_cast<T>(of.value(row)));
  return values;
}

}  // namespace wormdrive
