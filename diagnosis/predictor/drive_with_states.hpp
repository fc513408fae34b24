#pragma once
#include <algorithm>
#include <utility>

#include "core/states/starting_state.hpp"
#include "core/worm_drive.hpp"
#include "diagnosis/predictor/flight.hpp"
#include "diagnosis/predictor/restitution.hpp"
#include "diagnosis/rules/noise.hpp"
#include "events/simulate.hpp"
#include "events/taylor/solver.hpp"

namespace wormdrive {

/// A drive whose effects have states, or whose inertia depends on the angle, as the predictor follows it from sample to
/// sample: by the solver "taylor", event by event. What a recording does not show, as a current or a temperature, goes
/// on from sample to sample as the model has it. Its teeth are rigid and have no gap.
class DriveWithStates {
 public:
  using Drive = WormDrive<double, SummedLoad, true>;
  using Instant = Drive::Instant;
  struct State {
    Instant now;
  };
  using StatesOfEffects = Eigen::Matrix<double, Drive::state_size - 2, 1>;

  DriveWithStates(Drive drive, double /*gap*/, double /*compliance*/, const Restitution&)
      : drive_(std::move(drive)), solver_(drive_, settings()) {}
  DriveWithStates(const DriveWithStates&) = delete;
  DriveWithStates& operator=(const DriveWithStates&) = delete;

  Drive& drive() { return drive_; }
  const Drive& drive() const { return drive_; }
  /// What the gear's encoder shows [rad].
  double measured_angle(const State& s) const { return drive_.measured_angle(s.now); }
  bool at_rest(const State& s) const { return s.now.mode.motion == Motion::stuck; }
  /// The worm, counted at the gear.
  ShaftState worm(const State& s) const {
    const Transmission<double> turned = drive_.effects().transmission(s.now.x[0]);
    return {turned.angle, turned.slope * s.now.x[1]};
  }

  /// The state in which the gear stands here; effects start with it.
  State at(double t, const ShaftState& gear) const {
    State s;
    s.now.t = t;
    s.now.x = starting_state(drive_, {gear.angle, gear.speed}, t);
    return s;
  }
  State at(double t, const ShaftState& gear, const ShaftState& /*worm*/) const { return at(t, gear); }

  /// Moves the gear: what an observer finds out.
  void shift(State& s, double angle, double speed) const {
    s.now.x[0] += angle;
    s.now.x[1] += speed;
  }

  /// Runs to an end over which inputs that are not known beforehand are held.
  void run(State& s, double end) {
    Instant& now = s.now;
    keep_between_stops(drive_.effects(), now.x[0]);
    const auto go_on = [&] {
      now.mode = settle(drive_, solver_, now);
      solver_.restart(now);
    };
    go_on();
    int events = 0;
    for (double knot = drive_.next_knot(now.t);;) {
      const double stop = std::min(end, knot);
      if (const int guard = solver_.advance(now, stop, stop); guard != no_guard) {
        if (guard < Drive::guard_count) now = jump(drive_, solver_, now, guard);
        solver_.restart(now);
        if (++events > rules::most_events_of_a_sample) throw SolverFault("too many events within one sample");
        continue;
      }
      now.t = stop;
      if (stop == end) return;
      drive_.enter(stop);
      knot = drive_.next_knot(stop);
      go_on();
    }
  }

 private:
  static SolverSettings settings() {
    return {.solver = SolverKind::taylor,
            .relative_tolerance = rules::predictor_tolerance,
            .absolute_tolerance = 0.01 * rules::predictor_tolerance};
  }

  Drive drive_;
  TaylorSolver<Drive> solver_;
};

}  // namespace wormdrive
