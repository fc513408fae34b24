#pragma once
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "control/lemma1_conditions.hpp"
#include "core/unit.hpp"
#include "simulation/run_scenario.hpp"

namespace wormdrive {

/// What metrics are taken from.
struct Outcome {
  RunSummary run;
  std::vector<Condition> conditions;  ///< of Lemma 1, for the values of this run
  std::vector<double> own = {};       ///< of the metrics that the study makes of columns, in their order
};

/// One number that a trial comes to.
struct Metric {
  std::string name;  ///< "error_max"
  Unit unit;         ///< SI
  std::string meaning;
  std::function<double(const Outcome&)> of;  ///< not a number where a run has none
  /// What a run without it counts as: infinity for the time of something that never happened; not a number where
  /// nothing can be said.
  double missing = std::numeric_limits<double>::quiet_NaN();
  bool least_is_worst = false;  ///< unless a threshold says otherwise
  /// Of Lemma 1, whose margin the metric is; its values are those of the scenario itself.
  std::optional<Condition> condition = std::nullopt;

  /// What the value of a run that is done counts as, for thresholds.
  double counted(double value) const { return std::isnan(value) ? missing : value; }
};

/// All that runs of a scenario come to, whatever the values of its numbers are.
std::vector<Metric> metrics_of(const Scenario& scenario);

}  // namespace wormdrive
