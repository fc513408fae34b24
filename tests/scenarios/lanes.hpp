#pragma once
#include <bit>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "catch.hpp"
#include "events/simulation_failure.hpp"
#include "simulation/run_batch.hpp"

// Runs in the lanes of registers against the same runs alone.

namespace wormdrive::test {

/// A scenario with other numbers of drive, load and start, each within a share.
inline Scenario varied(Scenario scenario, std::mt19937_64& random, double share) {
  const auto vary = [&](double& x) { x *= 1.0 + share * std::uniform_real_distribution(-1.0, 1.0)(random); };
  auto& mesh = std::get<MeshParameters<double>>(scenario.mesh);
  for (double* number : {&mesh.mu, &mesh.Jw, &mesh.Jg}) vary(*number);
  if (auto* const arm = std::get_if<GravityArm>(&scenario.load)) {
    vary(*arm->amplitude);
    arm->offset += share * std::uniform_real_distribution(-1.0, 1.0)(random);
  }
  scenario.initial.theta_g = 0.05 * share * std::uniform_real_distribution(-1.0, 1.0)(random);
  return scenario;
}

/// Everything that a sweep can ask of a run, and what its solver did, bit by bit.
inline std::vector<std::uint64_t> bits(const RunSummary& run) {
  std::vector<std::uint64_t> all;
  const auto add = [&](double x) { all.push_back(std::bit_cast<std::uint64_t>(x)); };
  const auto count = [&](long n) { all.push_back(static_cast<std::uint64_t>(n)); };
  for_each_field<Metrics>([&](const auto& field) { add(run.control->metrics.*field.member); });
  count(run.control->follows);
  if (const auto& lemma = run.control->lemma) {
    add(lemma->reached());
    for (const Violation& v : lemma->violations()) {
      count(v.count);
      add(v.worst);
      add(v.first);
    }
  }
  for (const long events : run.events) count(events);
  for (const double x : {run.end.theta_g, run.end.omega_g, run.end.alpha_g, run.end.tau_m, run.end.normal_force})
    add(x);
  const SolverStatistics& s = run.statistics;
  for (const long n : {s.steps, s.evaluations, s.guard_evaluations, s.restarts}) count(n);
  return all;
}

/// How many of the results are not those of run_scenario().
inline int strangers(const std::vector<Scenario>& scenarios, const std::vector<BatchResult>& results) {
  int differ = 0;
  for (std::size_t k = 0; k < scenarios.size(); ++k) try {
      const RunSummary alone = run_scenario(scenarios[k]);
      const auto* const run = std::get_if<RunSummary>(&results[k]);
      differ += !run || bits(*run) != bits(alone);
    } catch (const SimulationFailure& halt) {
      const auto* const reason = std::get_if<std::string>(&results[k]);
      differ += !reason || *reason != halt.what();
    }
  return differ;
}

inline std::vector<LaneKind> available() {
  std::vector<LaneKind> kinds;
  for (const LaneKind kind : lane_kinds)
    if (is_available(kind)) kinds.push_back(kind);
  return kinds;
}

inline void require_the_same(const std::vector<Scenario>& scenarios) {
  for (const LaneKind kind : available()) {
    CAPTURE(static_cast<int>(kind));
    REQUIRE(strangers(scenarios, run_batch(scenarios, kind)) == 0);
  }
}

}  // namespace wormdrive::test
