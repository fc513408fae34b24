#pragma once
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "control/control_summary.hpp"
#include "description/scenario.hpp"

namespace wormdrive {

/// Prints what the controller comes to: gains of a PID, numbers and conditions of Lemma 1 for the sliding controller.
void print_design(const Scenario& scenario);
/// The same as JSON; null without a controller.
nlohmann::json design_as_json(const Scenario& scenario);

/// Prints the metrics of a run and what it broke of Lemma 1's promises, with times.
void print_control(const ControlSummary& summary);
nlohmann::json as_json(const ControlSummary& summary);

}  // namespace wormdrive
