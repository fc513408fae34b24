#pragma once
#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bindings/fmi/fmu_model.hpp"
#include "bindings/fmi/shown.hpp"
#include "description/build_control.hpp"
#include "events/simulate.hpp"
#include "events/taylor/solver.hpp"
#ifdef WORMDRIVE_FMU_CVODE
#include "events/cvode_solver.hpp"
#endif
#include "simulation/stepping/drive_numbers.hpp"

namespace wormdrive {

/// The solver inside keeps errors below this share in a second, whatever less the importer asks for: communication
/// points that cut its steps elsewhere then change no result by 1e-9.
inline constexpr double loosest_inside = 1e-12;
inline constexpr double tightest_inside = 1e-14;  ///< as in a scenario: below it is rounding

/// The solver inside: power series, or CVODE where teeth are elastic. It starts anew with every step, so that a step is
/// the same however the run came to its start.
template <class Drive>
struct SolverInside {
  using type = TaylorSolver<Drive>;
  static SolverSettings settings(double relative_tolerance) {
    const double share = std::clamp(relative_tolerance, tightest_inside, loosest_inside);
    return {.solver = SolverKind::taylor, .relative_tolerance = share, .absolute_tolerance = 0.01 * share};
  }
};
#ifdef WORMDRIVE_FMU_CVODE
/// CVODE errs by more than its tolerance in every step: the tightest that its arithmetic bears is asked for.
template <class T, class Load>
struct SolverInside<Commanded<CompliantDrive<T, Load>>> {
  using type = CvodeSolver<Commanded<CompliantDrive<T, Load>>>;
  static SolverSettings settings(double) {
    return {.method = Method::adams, .relative_tolerance = 1e-13, .absolute_tolerance = 1e-15};
  }
};
#endif

/// The same with what a scenario asks beyond them.
inline SolverSettings as_stated(SolverSettings inside, const RunSettings& run) {
  if (run.absolute_tolerance) inside.absolute_tolerance = std::min(*run.absolute_tolerance, inside.absolute_tolerance);
  inside.max_step = run.max_step;
  return inside;
}

/// Whether there is a solver inside for a drive.
template <class Drive>
inline constexpr bool solved_inside = shaft_count<Drive>() == 1 || elastic_teeth_inside;

/// A drive that goes from one communication point to the next by its own solver, through every event on the way; under
/// a motor torque that is held meanwhile, or with all that moves it inside.
template <class Drive>
class StepRun {
 public:
  using Ports = Interface<Drive>;
  using Instant = typename Drive::Instant;
  static constexpr std::size_t state_size = Drive::state_size, indicator_count = Ports::indicators.size();
  using States = std::array<double, state_size>;

  /// Starts at t [s] with a motor torque [N m], which counts for a plant only.
  StepRun(Drive drive, const FmuModel& model, double t, double torque, double relative_tolerance)
      : drive_(std::move(drive)),
        settings_(as_stated(SolverInside<Commanded<Drive>>::settings(relative_tolerance), model.scenario.run)),
        held_from_outside_(model.kind == FmuKind::plant),
        on_worm_(model.scenario.control && model.scenario.control->sensor.on_worm),
        torque_(torque),
        progress_{timetable(model.scenario, t), start(model.scenario.initial, t), EventLog()},
        indicators_(drive_, progress_.now),
        events_{0, t} {
    if (const auto& control = model.scenario.control)
      loop_.emplace(AnyController(control->law, make_nominal(model.scenario), make_variations(model.scenario),
                                  control->anti_windup),
                    control->reference, control->sensor, control->sampling, control->disturbance, Unheard{});
  }

  double torque() const { return torque_; }
  void set_torque(double torque, bool) { torque_ = torque; }
  double time() const { return progress_.now.t; }

  /// Whether outputs show the left limits of an event until pass_events(), as an importer with event mode asks for.
  void hold_left_limits() { holds_left_limits_ = true; }

  /// Goes on to a time [s]. end(t), asked at every change of mode, may end the step earlier: there, or at a later time
  /// [s]. Throws SimulationFailure where the drive cannot go on; it then stands where it halted.
  void step(double until, const std::function<double(double)>& end) {
    go(until, [&](double t, bool event) { return event ? end(t) : never; });
  }
  /// When the controller of a loop takes its next sample [s].
  double next_sample() const { return progress_.timetable.sample_time(static_cast<long>(loop_->samples())); }
  /// When it took its latest [s], if it has taken one.
  std::optional<double> latest_sample() const {
    const auto taken = static_cast<long>(loop_->samples());
    if (taken == 0) return {};
    return progress_.timetable.sample_time(taken - 1);
  }
  /// Goes on to the next sample and takes it. Throws as step() does.
  void take_sample() {
    const std::uint64_t taken = loop_->samples();
    go(std::nextafter(next_sample(), never), [&](double t, bool) { return loop_->samples() > taken ? t : never; });
    left_.reset();
  }
  /// What the motor was told last [N m]; 0 before that.
  double commanded() const { return commanded_.value_or(0.0); }

  /// Takes the event at which the last step ended.
  void pass_events() { left_.reset(); }
  /// Events are found inside; nobody has to stop for them.
  double next_event_time() const { return never; }

  States states() const {
    States x;
    std::copy_n(progress_.now.x.data(), state_size, x.begin());
    return x;
  }
  States rates() const {
    const Instant& now = progress_.now;
    const auto x = drive_.derivative(now.t, now.x, now.mode);
    States rate;
    std::copy_n(x.data(), state_size, rate.begin());
    return rate;
  }
  std::array<double, indicator_count> indicators() const { return indicators_.all(drive_, progress_.now); }
  /// What is shown, with the derivatives by time. Of an event that is not taken it is that just behind it.
  auto along_motion() const { return wormdrive::along_motion<Drive>(drive_, indicators_, progress_.now, on_worm_); }
  Observation observe() const { return left_ ? left_->at : drive_.observe(progress_.now); }
  double measured_angle() const { return encoder_angle(drive_, drive_.moment(progress_.now), on_worm_); }
  const EventTally& events() const { return left_ ? left_->events : events_; }

  // ---- as numbers ------------------------------------------------------------------------------------------------

  /// All that changes; the same bits follow from them.
  void write(std::vector<double>& to) const {
    if (left_) throw std::logic_error("the event at which the step ended is to be handled first");
    write_instant<Drive>(progress_.now, to);
    to.insert(to.end(), indicators_.scales().begin(), indicators_.scales().end());
    const InputMemory& past = drive_.memory();
    write_inputs(past, drive_.knot(), to);
    const bool begun = progress_.cause.reason == Reason::end;
    to.insert(to.end(), {drive_.disturbance(), double(begun), double(commanded_.has_value()), commanded_.value_or(0.0),
                         double(events_.count), events_.latest, double(past.on_the_way.size())});
    for (const auto& [t, torque] : past.on_the_way) to.insert(to.end(), {t, torque});
    if (!loop_) return;
    const std::vector<double> memory = loop_->memory();
    to.insert(to.end(), memory.begin(), memory.end());
  }
  /// Takes up such numbers; false where they are none. The run has to be a fresh one of the same model.
  bool read(std::span<const double> from) {
    NumberReader next(from);
    const std::optional<Instant> now = read_instant<Drive>(next);
    for (double& scale : indicators_.scales()) scale = next();
    double knot = 0.0;
    InputMemory past = read_inputs(next, knot);
    const double disturbance = next();
    const bool begun = next() != 0.0, is_commanded = next() != 0.0;
    const double commanded = next();
    events_.count = static_cast<int>(next());
    events_.latest = next();
    for (double left = next(); left >= 1.0; --left) {
      const double t = next();
      past.on_the_way.push({t, next()});
      if (past.on_the_way.size() > from.size()) return false;
    }
    if (!now) return false;
    if (loop_ && !loop_->recall(next.rest())) return false;
    if (!begun) return true;  // as it was made
    drive_.recall(past, knot);
    drive_.disturb(disturbance);
    if (is_commanded) commanded_ = commanded;
    progress_.now = *now;
    progress_.cause = {Reason::end};
    if (loop_)
      progress_.timetable.take_up(static_cast<long>(loop_->samples()),
                                  static_cast<long>(loop_->samples() + loop_->latched()));
    progress_.timetable.schedule_knot(knot);
    latest_ = *now;
    return true;
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();

  /// What is shown of an event that the importer has not taken.
  struct Left {
    Observation at;
    EventTally events;
  };
  /// A loop's records are for those who watch a run.
  struct Unheard {
    void operator()(const ControlRecord&) const {}
  };
  using Loop = ClosedLoop<AnyController, Unheard>;
  using Solver = typename SolverInside<Commanded<Drive>>::type;

  /// In the place of a controller: the loop inside, or the torque from outside.
  struct Mover {
    StepRun& run;
    double sample(Commanded<Drive>& drive, const Instant& now) const {
      if (!run.loop_) return run.torque_;
      return *(run.commanded_ = run.loop_->sample(drive, now));
    }
    void latch(const Commanded<Drive>& drive, const Instant& now) const {
      if (run.loop_) run.loop_->latch(drive, now);
    }
  };

  /// Goes on to a time [s]; end(t, event) says on the way when to end instead [s], event being a change of mode. No
  /// template: the solver is compiled once.
  void go(double until, const std::function<double(double, bool)>& end) {
    left_.reset();
    Solver solver(drive_, settings_);
    prepare(solver, until);
    Mover mover{*this};
    std::optional<Left> left;
    go_on(drive_, solver, mover, progress_, [&](const Commanded<Drive>& drive, const Instant& now) {
      const bool later = !latest_ || latest_->t != now.t;
      const bool event = !later && !(latest_->mode == now.mode);
      if (later && holds_left_limits_) left = Left{drive.observe(now), events_};
      latest_ = now;
      if (event) events_.add(now.t);
      until = std::max(now.t, std::min(until, end(now.t, event)));
      if (event && until == now.t) left_ = left;
      progress_.timetable.end_at(until);
    });
  }

  Timetable timetable(const Scenario& scenario, double t) const {
    const auto& control = scenario.control;
    if (!control) return {t, never, never};
    return {t, never, never, {control->sampling.period, control->sampling.offset, drive_.effects().measuring_delay()}};
  }
  Instant start(const InitialState<double>& initial, double t) {
    drive_.enter(t);
    if (held_from_outside_) drive_.command(t, torque_);
    Instant now;
    now.t = t;
    now.x = starting_state(drive_, initial, t);
    now.mode = drive_.settle(now);
    drive_.next_knot(t);
    return now;
  }

  /// A torque from outside is commanded where it changes; else the run is taken up where it was left.
  void prepare(Solver& solver, double until) {
    const Instant& now = progress_.now;
    if (held_from_outside_ && (!commanded_ || *commanded_ != torque_)) {
      commanded_ = torque_;
      if (drive_.knot() <= now.t) {  // the load changes with the torque: one event, not two
        drive_.enter(now.t);
        drive_.next_knot(now.t);
      }
      progress_.timetable = Timetable(now.t, until, never, {.offset = 0.0});
      progress_.timetable.schedule_knot(drive_.knot());
      progress_.cause = {progress_.timetable.pop()};
      return;
    }
    progress_.timetable.end_at(until);
    if (progress_.cause.reason != Reason::end) return;  // the very first step
    progress_.cause = {Reason::report};
    if (!Drive::at_rest(now.mode)) solver.restart(now);
  }

  Commanded<Drive> drive_;
  SolverSettings settings_;
  bool held_from_outside_;
  bool on_worm_;  ///< where the encoder sits, which shows the gear by the worm
  double torque_;
  std::optional<double> commanded_;  ///< what the motor was told last [N m]
  std::optional<Loop> loop_;
  Progress<Commanded<Drive>> progress_;
  Indicators<Drive> indicators_;
  EventTally events_;
  std::optional<Instant> latest_;
  bool holds_left_limits_ = false;
  std::optional<Left> left_;
};

}  // namespace wormdrive
