#include "scenarios/second_opinion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "events/cvode_solver.hpp"
#include "events/simulate.hpp"
#include "scenarios/build.hpp"
#include "scenarios/run_scenario.hpp"

namespace wormdrive {
namespace {

/// A run as far as another one can be held against it.
struct Testimony {
  std::vector<Row> rows;
  std::vector<double> torques;  ///< held from each sample on [N m]
};

Testimony testimony_of(const Scenario& scenario) {
  Testimony told;
  run_scenario(
      scenario,
      {.rows = [&](const Trajectory& part) { told.rows.insert(told.rows.end(), part.rows.begin(), part.rows.end()); },
       .samples =
           [&](const std::vector<ControlRecord>& part) {
             for (const ControlRecord& record : part) told.torques.push_back(record.applied);
           }});
  return told;
}

/// Gives recorded torques again.
struct RecordedController {
  std::vector<double> torques;
  std::size_t next = 0;

  template <class System>
  double sample(const System&, const typename System::Instant&) {
    return torques.at(next++);
  }
};

template <class Drive>
Disagreement compared(Drive& drive, const Scenario& scenario, Testimony told) {
  SolverSettings settings = scenario.run.solver_settings();
  settings.solver = SolverKind::cvode;
  CvodeSolver<Drive> solver(drive, settings);
  Sampling sampling;
  if (scenario.control) {
    const SamplingSettings& stated = scenario.control->sampling;
    sampling = {stated.period, stated.offset, drive.effects().measuring_delay()};
  }
  typename Drive::Instant start;
  start.x = {scenario.initial.theta_g, scenario.initial.omega_g};
  Disagreement largest;
  auto row = told.rows.begin();
  RecordedController recorded{std::move(told.torques)};
  simulate(drive, solver, recorded, Timetable(0.0, scenario.run.duration, scenario.run.rows_every(), sampling), start,
           [&](const Drive&, const typename Drive::Instant& now) {
             while (row != told.rows.end() && row->t < now.t) ++row;
             if (row == told.rows.end() || row->t != now.t) return;  // an event, which has its own time in every run
             const double angle = std::abs(row->at.theta_g - now.x[0]);
             if (angle > largest.angle) largest.t = now.t;
             largest.angle = std::max(largest.angle, angle);
             largest.speed = std::max(largest.speed, std::abs(row->at.omega_g - now.x[1]));
           });
  return largest;
}

}  // namespace

Disagreement second_opinion(const Scenario& scenario) {
  Testimony told = testimony_of(scenario);
  return with_drive(scenario, [&](auto& drive) { return compared(drive, scenario, std::move(told)); });
}

}  // namespace wormdrive
