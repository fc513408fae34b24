#include "scenarios/run_scenario.hpp"

#include <utility>

#include "events/simulate.hpp"
#include "events/solvers.hpp"
#include "scenarios/build.hpp"

namespace wormdrive {
namespace {

constexpr std::size_t portion = 4096;  ///< rows handed over at a time, one chunk of the result file

template <class Drive, class Solver>
RunSummary run(Drive& drive, Solver& solver, const Scenario& scenario, const RunListeners& listeners) {
  TrajectoryRecorder recorder;
  AuditTrail<Drive, Solver> trail{solver};
  RunSummary summary;
  const auto hand_over = [&] {
    Trajectory part = recorder.drain();
    for (const Event& event : part.events) ++summary.events[static_cast<std::size_t>(event.kind())];
    if (listeners.rows) listeners.rows(std::move(part));
  };
  const auto record = [&](const Drive& d, const typename Drive::Instant& now) {
    recorder(d, now);
    if (listeners.audit) trail(d, now);
    if (recorder.trajectory().rows.size() > portion) hand_over();
    if (listeners.time) listeners.time(now.t);
  };
  typename Drive::Instant start;
  start.x = {scenario.initial.theta_g, scenario.initial.omega_g};
  try {
    simulate(drive, solver, Timetable(0.0, scenario.run.duration, scenario.run.rows_every()), start, record);
  } catch (const Halt&) {
    recorder.close();
    hand_over();
    throw;
  }
  summary.end = recorder.trajectory().rows.back().at;
  recorder.close();
  hand_over();
  summary.statistics = solver.statistics();
  if (listeners.audit) summary.audit = Audit<Drive>(drive).examine(trail);
  return summary;
}

}  // namespace

RunSummary run_scenario(const Scenario& scenario, const RunListeners& listeners) {
  return with_drive(scenario, [&](auto& drive) {
    return with_solver(drive, scenario.run.solver_settings(),
                       [&](auto& solver) { return run(drive, solver, scenario, listeners); });
  });
}

Trajectory simulate_scenario(const Scenario& scenario) {
  Trajectory whole;
  run_scenario(scenario, {.rows = [&](const Trajectory& part) {
                 whole.rows.insert(whole.rows.end(), part.rows.begin(), part.rows.end());
                 whole.events.insert(whole.events.end(), part.events.begin(), part.events.end());
               }});
  return whole;
}

}  // namespace wormdrive
