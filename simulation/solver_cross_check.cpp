#include "simulation/solver_cross_check.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/states/starting_state.hpp"
#include "description/build.hpp"
#include "events/cvode_solver.hpp"
#include "events/simulate.hpp"
#include "simulation/run_scenario.hpp"

namespace wormdrive {
namespace {

/// A run as far as another one can be held against it.
struct SolverCrossCheck {
  std::vector<Row> rows;
  std::vector<ControlRecord> samples;
};

SolverCrossCheck testimony_of(const Scenario& scenario) {
  SolverCrossCheck told;
  run_scenario(
      scenario,
      {.rows = [&](const Trajectory& part) { told.rows.insert(told.rows.end(), part.rows.begin(), part.rows.end()); },
       .samples =
           [&](const std::vector<ControlRecord>& part) {
             told.samples.insert(told.samples.end(), part.begin(), part.end());
           }});
  return told;
}

/// Holds states against rows, both in rising order of time; an event has its own time in every run.
class Comparison {
 public:
  explicit Comparison(const std::vector<Row>& rows) : row_(rows.begin()), end_(rows.end()) {}

  void at(double t, double theta_g, double omega_g) {
    while (row_ != end_ && row_->t < t) ++row_;
    if (row_ == end_ || row_->t != t) return;
    const double angle = std::abs(row_->at.theta_g - theta_g);
    if (angle > largest_.angle) largest_.t = t;
    largest_.angle = std::max(largest_.angle, angle);
    largest_.speed = std::max(largest_.speed, std::abs(row_->at.omega_g - omega_g));
  }
  const Disagreement& largest() const { return largest_; }

 private:
  std::vector<Row>::const_iterator row_, end_;
  Disagreement largest_;
};

/// Gives recorded torques again.
struct RecordedController {
  const std::vector<ControlRecord>& samples;
  std::size_t next = 0;

  template <class System>
  double sample(System& system, const typename System::Instant&) {
    const ControlRecord& then = samples.at(next++);
    system.disturb(then.disturbance);
    return then.applied;
  }
};

template <class Drive>
Disagreement replayed(Drive drive, const Scenario& scenario, const SolverCrossCheck& told) {
  CvodeSolver<Drive> solver(drive, scenario.run.solver_settings());
  Sampling sampling;
  if (scenario.control) {
    const SamplingSettings& stated = scenario.control->sampling;
    sampling = {stated.period, stated.offset, drive.effects().measuring_delay()};
  }
  drive.enter(0.0);
  typename Drive::Instant start;
  start.x = starting_state(drive, scenario.initial, 0.0);
  Comparison comparison(told.rows);
  RecordedController recorded{told.samples};
  simulate(drive, solver, recorded, Timetable(0.0, scenario.run.duration, scenario.run.rows_every(), sampling), start,
           [&](const Drive&, const typename Drive::Instant& now) { comparison.at(now.t, now.x[0], now.x[1]); });
  return comparison.largest();
}

Disagreement compared(const SolverCrossCheck& told, const SolverCrossCheck& other) {
  Comparison comparison(told.rows);
  for (const Row& row : other.rows) comparison.at(row.t, row.at.theta_g, row.at.omega_g);
  return comparison.largest();
}

std::optional<double> parting(const SolverCrossCheck& told, const SolverCrossCheck& other) {
  const auto [first, second] = std::mismatch(
      told.samples.begin(), told.samples.end(), other.samples.begin(), other.samples.end(),
      [](const ControlRecord& a, const ControlRecord& b) { return a.measured.angle == b.measured.angle; });
  return first == told.samples.end() ? std::nullopt : std::optional(first->measured.t);
}

Scenario with_cvode(Scenario scenario) {
  scenario.run.solver = SolverKind::cvode;
  return scenario;
}

}  // namespace

Disagreement cross_check(const Scenario& scenario) {
  const SolverCrossCheck told = testimony_of(scenario);
  const Scenario again = with_cvode(scenario);
  return again.effects.have_states() ? replayed(make_drive<true>(again), again, told)
                                     : replayed(make_drive(again), again, told);
}

LoopCrossCheck cross_check_in_the_loop(const Scenario& scenario) {
  const SolverCrossCheck told = testimony_of(scenario), other = testimony_of(with_cvode(scenario));
  if (scenario.control->sensor.counts > 0.0) return {{}, parting(told, other)};
  return {compared(told, other), {}};
}

}  // namespace wormdrive
