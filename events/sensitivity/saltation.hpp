#pragma once
#include "events/event_sequence.hpp"

namespace wormdrive {

/// The time at which a guard falls through zero [s], with its derivatives by the parameters that the state carries: the
/// guard's own derivatives along the run over the rate at which it falls.
template <class Drive>
auto crossing_time(const Drive& drive, const typename Drive::Instant& now, int guard) {
  const auto ahead = drive.guards_ahead(now)[guard];
  auto t = ahead[0];
  t.a = now.t;
  t.v /= -ahead[1].a;
  return t;
}

/// The derivatives of a state just behind an event that moves in time: s+ = s- + (f- - f+) dt/dp, for up to the event
/// the state flows with the derivative of the mode before, f-, and from there on with that of the mode behind, f+.
template <class State, class T>
State saltated(const State& x, const State& before, const State& behind, const T& t) {
  return x + (before - behind) * T(t - t.a);
}

/// Gives a state of Jets the values of the run; its derivatives stay.
template <class Instant, class State>
void take_values(Instant& now, const State& x) {
  for (int k = 0; k < x.size(); ++k) now.x[k].a = x[k];
}

/// Takes a state of Jets across a stop of the course and returns the time of the stop, with derivatives [s]. Mode and
/// values are those of the course; the inputs of the drive go on to what holds behind the stop.
///
/// A knot of the motor's command moves with its delay, which a knot of the load does not: the load goes first.
template <class Drive, class Stop>
auto cross(Drive& drive, typename Drive::Instant& now, const Stop& stop) {
  using T = typename Drive::State::Scalar;
  take_values(now, stop.before.x);
  if (stop.cause.reason == Reason::knot) drive.enter_load(now.t);
  const auto before = drive.derivative(now.t, now.x, now.mode);
  T t(now.t);
  switch (stop.cause.reason) {
    case Reason::guard:
      if (stop.cause.guard >= Drive::guard_count) return t;  // at a bend the derivative goes on
      t = crossing_time(drive, now, stop.cause.guard);
      break;
    case Reason::knot:
      drive.enter_motor(now.t);
      t = drive.motor_arrival();
      break;
    case Reason::sample:
      drive.disturb(stop.disturbance);
      drive.command(now.t, stop.cause.torque);
      t = drive.motor_arrival();
      break;
    case Reason::latch:
    case Reason::report:
    case Reason::end: return t;
  }
  now.mode = stop.after.mode;
  now.x = saltated(now.x, before, drive.derivative(now.t, now.x, now.mode), t);
  take_values(now, stop.after.x);
  if (Drive::at_rest(now.mode)) now.x[1] = T(0.0);  // at rest whatever the parameters are
  if (stop.after.since != stop.before.since) now.since = t;
  return t;
}

}  // namespace wormdrive
