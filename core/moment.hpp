#pragma once

#include "core/mode.hpp"
#include "core/numbers/jet.hpp"

namespace wormdrive {

/// What equations may depend on: time [s], gear angle [rad], gear speed and worm speed [rad/s], worm angle [rad], and
/// how long the gear has been at rest [s], negative unless it is.
template <class S>
struct Moment {
  S t;
  S theta_g;
  S omega_g;
  S omega_w;
  S theta_w{};
  S rest{-1.0};
};

/// A moment of a drive that turns, for what depends on the direction alone.
template <class S>
Moment<S> turning() {
  return {S(0.0), S(0.0), S(1.0), S(1.0), S(0.0)};
}

/// A moment that says what the motor is told [N m], in the place of its input: for derivatives by that.
template <class S>
struct CommandedMoment : Moment<S> {
  S command;
};

/// The same of a drive in a state that says since when the gear has been at rest, if it is. M: any moment.
template <class M, class Instant>
M resting(M at, const Instant& now) {
  if (now.mode.motion == Motion::stuck) at.rest = at.t - decltype(at.t)(now.since);
  return at;
}

}  // namespace wormdrive
