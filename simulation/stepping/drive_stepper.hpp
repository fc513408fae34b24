#pragma once
#include <algorithm>
#include <type_traits>
#include <utility>

#include "core/states/starting_state.hpp"
#include "events/simulate.hpp"
#include "events/solvers.hpp"
#include "output/event_counter.hpp"
#include "simulation/stepping/commanded.hpp"
#include "simulation/stepping/drive_numbers.hpp"
#include "simulation/stepping/stepped_drive.hpp"

namespace wormdrive {

/// A drive of one type, rigid or compliant, with one solver.
template <class Drive, class Solver>
class DriveStepper final : public SteppedDrive {
 public:
  using Instant = typename Drive::Instant;

  /// lane: whether nothing but a held torque and an arm under gravity moves it.
  DriveStepper(Drive drive, const Scenario& scenario, bool lane)
      : drive_(std::move(drive)), solver_(drive_, scenario.run.solver_settings()), start_(scenario.initial) {
    begin();
    if constexpr (requires { solver_.nominal().driven(Mode{}); })
      lane_ = lane && solver_.nominal().driven({Motion::forward, Flank::left}) &&
              !solver_.nominal().rubs({Motion::forward, Flank::left}) && !solver_.nominal().curve().falls();
  }

  StepState state() const override {
    const Instant& now = progress_.now;
    const auto at = drive_.moment(now);
    return {now.t, drive_.observe(now), at.theta_w, at.omega_w};
  }
  StepPlace place() const override {
    const auto& x = progress_.now.x;
    constexpr int gear = 2 * shaft_count<Drive>() - 2;
    return {x[gear], x[gear + 1], progress_.now.mode};
  }
  std::array<long, event_kind_count> events() const override {
    std::array<long, event_kind_count> all = earlier_;
    for (std::size_t k = 0; k < all.size(); ++k) all[k] += counter_.events()[k];
    return all;
  }

  std::optional<DrivenMotion> lane_motion() const override {
    if constexpr (requires { solver_.nominal().driven(Mode{}); }) {
      if (!lane_) return std::nullopt;
      return Drive::at_rest(progress_.now.mode) ? DrivenMotion{} : *solver_.nominal().driven(progress_.now.mode);
    } else {
      return std::nullopt;
    }
  }
  SineAndCosine arm_offset() const override {
    if constexpr (requires { solver_.nominal().arm_offset(); }) return solver_.nominal().arm_offset();
    return SteppedDrive::arm_offset();
  }

  void take_up(double t, double theta_g, double omega_g) override {
    if constexpr (Drive::state_size == 2) {
      progress_.now.t = t;
      progress_.now.x = {theta_g, omega_g};
      if (t > 0.0) counter_(drive_, progress_.now);
    }
  }
  void tell(double t, double torque) override { drive_.command(t, torque); }
  void go_on(double torque, double until) override {
    HeldTorque held{torque};
    const double t = progress_.now.t;
    if (drive_.knot() <= t) {  // the load changes with the torque: one event, not two
      drive_.enter(t);
      drive_.next_knot(t);
    }
    progress_.timetable = Timetable(t, until, never, {.offset = 0.0});
    progress_.timetable.schedule_knot(drive_.knot());
    progress_.cause = {progress_.timetable.pop()};
    wormdrive::go_on(drive_, solver_, held, progress_,
                     [this](const Drive& drive, const Instant& now) { counter_(drive, now); });
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();

  /// In the place of a controller.
  struct HeldTorque {
    double torque;
    double sample(const Commanded<Drive>&, const Instant&) const { return torque; }
  };

  void begin() override {
    drive_.rewind();
    drive_.enter(0.0);
    Instant start;
    start.x = starting_state(drive_, start_, 0.0);
    start.mode = drive_.settle(start);
    drive_.next_knot(0.0);
    progress_ = {Timetable(0.0, never, never), start, EventLog()};
    counter_ = {};
    earlier_ = {};
  }

  void write(std::vector<double>& to) const override {
    write_instant<Drive>(progress_.now, to);
    const InputMemory& past = drive_.memory();
    write_inputs(past, drive_.knot(), to);
    for (const long count : events()) to.push_back(static_cast<double>(count));
    for (const auto& [t, torque] : past.on_the_way) to.insert(to.end(), {t, torque});
  }
  static constexpr std::size_t fixed_numbers = instant_numbers<Drive> + input_numbers + event_kind_count;

  bool read(std::span<const double> from) override {
    if (from.size() < fixed_numbers || (from.size() - fixed_numbers) % 2 != 0) return false;
    NumberReader next(from);
    const std::optional<Instant> then = read_instant<Drive>(next);
    if (!then) return false;
    const Instant& now = *then;
    double knot = 0.0;
    InputMemory past = read_inputs(next, knot);
    for (long& count : earlier_) count = static_cast<long>(next());
    while (!next.rest().empty()) {
      const double t = next();
      past.on_the_way.push({t, next()});
    }
    drive_.recall(past, knot);
    progress_ = {Timetable(0.0, never, never), now, EventLog()};
    counter_ = {};
    if (now.t > 0.0) counter_(drive_, now);  // before the first step no change of mode is an event
    return true;
  }

  Commanded<Drive> drive_;
  Solver solver_;
  InitialState<double> start_;
  bool lane_ = false;
  EventCounter<Drive> counter_;
  std::array<long, event_kind_count> earlier_{};  ///< events before the snapshot that was taken up
  Progress<Commanded<Drive>> progress_{Timetable(0.0, never, never), {}, EventLog()};
};

/// A stepper of a drive with the solver that its scenario names.
template <class Drive>
std::unique_ptr<SteppedDrive> stepper_of(Drive drive, const Scenario& scenario, bool lane) {
  if constexpr (shaft_count<Drive>() == 1)
    if (scenario.run.solver == SolverKind::taylor)
      return std::make_unique<DriveStepper<Drive, TaylorSolver<Drive>>>(std::move(drive), scenario, lane);
  return std::make_unique<DriveStepper<Drive, CvodeSolver<Drive>>>(std::move(drive), scenario, lane);
}

/// The drive of a scenario whose teeth are elastic.
std::unique_ptr<SteppedDrive> make_compliant_stepper(const Scenario& scenario);
/// The drive of a scenario whose effects have states.
std::unique_ptr<SteppedDrive> make_stepper_with_states(const Scenario& scenario);

}  // namespace wormdrive
