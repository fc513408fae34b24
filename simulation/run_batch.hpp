#pragma once
#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "control/lanes/kind.hpp"
#include "simulation/run_scenario.hpp"

namespace wormdrive {

/// What a run amounts to, or why it could not go on.
using BatchResult = std::variant<RunSummary, std::string>;

/// Simulates a scenario as run_scenario() does, with what stops it as an answer.
BatchResult run_alone(const Scenario& scenario, const RunListeners& listeners = {});

/// How many scenarios that differ from this one in numbers alone are best run together; 1 if each runs alone anyway.
int runs_together(const Scenario& scenario);

/// Simulates scenarios as run_scenario() does, with the same bits: those that differ in numbers of drive and controller
/// alone, sampled by a sliding controller and solved by power series, several at once in the lanes of one register.
std::vector<BatchResult> run_batch(std::span<const Scenario> scenarios, LaneKind kind = widest_lanes());
/// The same; take(place, result) gets each as soon as it is there, so that one that takes long holds back no other.
void run_batch(std::span<const Scenario> scenarios, const std::function<void(std::size_t, BatchResult)>& take,
               LaneKind kind);

}  // namespace wormdrive
