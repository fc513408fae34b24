#pragma once
#include <utility>
#include <vector>

#include "core/states/starting_state.hpp"
#include "description/build_control.hpp"
#include "events/simulate.hpp"
#include "events/solvers.hpp"
#include "output/event_counter.hpp"
#include "simulation/replay.hpp"
#include "simulation/run_scenario.hpp"

namespace wormdrive {

inline constexpr std::size_t portion = 4096;  ///< rows handed over at a time, one chunk of the result file

/// One run of one drive, rigid or compliant: what is recorded on the way, and its summary.
template <class Drive, class Solver>
class DriveRun {
 public:
  using Instant = typename Drive::Instant;

  DriveRun(Drive& drive, Solver& solver, const Scenario& scenario, const RunListeners& listeners)
      : drive_(drive), solver_(solver), scenario_(scenario), listeners_(listeners) {}

  RunSummary operator()() {
    try {
      if (scenario_.control)
        controlled(*scenario_.control);
      else
        open_loop();
    } catch (const SimulationFailure&) {
      finish_rows();
      throw;
    }
    return finish();
  }

  // ---- the parts, for a run that others carry on ---------------------------------------------------------------

  Timetable timetable(const ControlScenario& control) const {
    return {0.0,
            scenario_.run.duration,
            scenario_.run.rows_every(),
            {control.sampling.period, control.sampling.offset, drive_.effects().measuring_delay()}};
  }
  Instant start() const {
    if constexpr (Drive::state_size > 2) drive_.enter(0.0);
    Instant start;
    start.x = starting_state(drive_, scenario_.initial, 0.0);
    return start;
  }
  void record(const Drive& drive, const Instant& now) {
    if (listeners_.rows)
      recorder_(drive, now);
    else
      counter_(drive, now);
    if (listeners_.audit) trail_(drive, now);
    if (recorder_.trajectory().rows.size() > portion || samples_.size() > portion) hand_over();
    if (listeners_.time) listeners_.time(now.t);
  }

  /// Counts flank changes of which no rows are kept.
  void changed_flank(long times) { counter_.changed_flank(times); }

  /// What a run amounts to that has come to its end.
  RunSummary finish() {
    if (listeners_.rows) {
      summary_.end = recorder_.trajectory().rows.back().at;
    } else {
      summary_.events = counter_.events();
      summary_.end = counter_.end(drive_);
    }
    finish_rows();
    summary_.statistics = solver_.statistics();
    if (listeners_.audit) audit();
    return std::move(summary_);
  }
  /// The same of a controlled run.
  RunSummary finish(const ControlWatch& watch) {
    conclude(watch);
    return finish();
  }

 private:
  void open_loop() {
    simulate(drive_, solver_, Timetable(0.0, scenario_.run.duration, scenario_.run.rows_every()), start(),
             [this](const Drive& drive, const Instant& now) { record(drive, now); });
  }

  void controlled(const ControlScenario& control) {
    const NominalModel nominal = make_nominal(scenario_);
    const Variations variations = make_variations(scenario_);
    ControlWatch watch(control.window, control.law, lemma1(nominal, variations));
    const auto listen = [&](const ControlRecord& sample) {
      watch.sample(sample);
      if (listeners_.samples) samples_.push_back(sample);
      if (listeners_.audit) held_.push_back({sample.measured.t, sample.applied, sample.disturbance});
    };
    ClosedLoop loop(AnyController(control.law, nominal, variations, control.anti_windup), control.reference,
                    control.sensor, control.sampling, control.disturbance, listen);
    simulate(drive_, solver_, loop, timetable(control), start(), [&](const Drive& drive, const Instant& now) {
      watch.meter.instant(now.t, now.mode);
      record(drive, now);
    });
    conclude(watch);
  }
  void conclude(const ControlWatch& watch) {
    summary_.control = watch.summary();
    summary_.control->follows = !scenario_.control->reference.terms.empty();
  }

  void hand_over() {
    Trajectory part = recorder_.drain();
    for (const Event& event : part.events) ++summary_.events[static_cast<std::size_t>(event.kind())];
    if (listeners_.rows) listeners_.rows(std::move(part));
    if (listeners_.samples) listeners_.samples(std::exchange(samples_, {}));
  }
  void finish_rows() {
    recorder_.close();
    hand_over();
  }

  void audit() {
    using Replayed = Replay<Drive>;
    Replayed replayed(drive_, std::move(held_));
    summary_.audit = Audit<Replayed>(replayed).examine(trail_);
  }

  Drive& drive_;
  Solver& solver_;
  const Scenario& scenario_;
  const RunListeners& listeners_;
  TrajectoryRecorder recorder_;  ///< while somebody wants rows
  EventCounter<Drive> counter_;  ///< else
  AuditTrail<Drive, Solver> trail_{solver_};
  std::vector<ControlRecord> samples_;
  std::vector<typename Replay<Drive>::Held> held_;
  RunSummary summary_;
};

/// Runs a drive with the solver that its scenario names.
template <class Drive>
RunSummary run_drive(Drive& drive, const Scenario& scenario, const RunListeners& listeners) {
  return with_solver(drive, scenario.run.solver_settings(), [&]<class Solver>(Solver& solver) {
    return DriveRun<Drive, Solver>(drive, solver, scenario, listeners)();
  });
}

/// Runs a scenario whose teeth are elastic.
RunSummary run_compliant(const Scenario& scenario, const RunListeners& listeners);
/// Runs a scenario whose effects have states.
RunSummary run_with_states(const Scenario& scenario, const RunListeners& listeners);

}  // namespace wormdrive
