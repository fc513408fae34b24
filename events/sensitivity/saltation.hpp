#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

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

/// Gives a state of Jets the values of the run; its derivatives stay.
template <class Instant, class State>
void take_values(Instant& now, const State& x) {
  for (int k = 0; k < x.size(); ++k) now.x[k].a = x[k];
}

/// Takes a state of Jets so far [s] behind a bend, and not beyond a limit, that no rounding hides on which side of it
/// the motion is: there the derivatives have another law. At the bend itself the rates of both sides are the same.
template <class Drive>
void leave_bend(const Drive& drive, typename Drive::Instant& now, double hidden, double limit) {
  using T = typename Drive::State::Scalar;
  constexpr double later = std::numeric_limits<double>::infinity();
  const double t = std::min(std::max(now.t + hidden, std::nextafter(now.t, later)), limit);
  now.x += drive.derivative(now.t, now.x, now.mode) * T(t - now.t);
  now.t = t;
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
      if (stop.is_bend()) return t;  // the derivative goes on
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
  // Up to the event the state flows with the derivative of the mode before, from there on with that of the mode behind,
  // and between them it may jump.
  const T late = t - t.a;
  now.x += before * late;
  if constexpr (Drive::guard_count > Drive::stop_guard)
    if (stop.cause.guard == Drive::stop_guard) strike(drive, now, [&](const auto&) { return stop.after.x[1] != 0.0; });
  now.mode = stop.after.mode;
  take_values(now, stop.after.x);
  now.x -= drive.derivative(now.t, now.x, now.mode) * late;
  if (now.mode.motion == Motion::stuck) now.x[1] = T(0.0);  // at rest whatever the parameters are
  if (stop.after.since != stop.before.since) now.since = t;
  return t;
}

}  // namespace wormdrive
