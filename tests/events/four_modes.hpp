#pragma once
#include <algorithm>

#include "core/mode.hpp"
#include "numbers.hpp"

namespace wormdrive::test {

// The modes of a worm drive for judges that have equations of their own: acceleration(mode) is theirs where the drive
// is now, beyond > 0 where the right flank would carry.

constexpr Flank flank_beyond(double beyond) { return beyond > 0.0 ? Flank::right : Flank::left; }

/// How the drive goes on from rest.
template <class Acceleration>
Mode mode_from_rest(double beyond, const Acceleration& acceleration) {
  for (const Motion motion : {Motion::forward, Motion::backward})
    if (const Mode mode{motion, flank_beyond(beyond)}; sign(motion) * acceleration(mode) > 0.0) return mode;
  return {};
}

/// Whether a mode still holds at a speed of the gear.
template <class Acceleration>
bool mode_holds(Mode mode, double speed, double beyond, const Acceleration& acceleration) {
  if (mode.motion != Motion::stuck) return sign(mode.motion) * speed >= 0.0 && -sign(mode.flank) * beyond >= 0.0;
  return acceleration(Mode{Motion::forward, flank_beyond(beyond)}) <= 0.0 &&
         acceleration(Mode{Motion::backward, flank_beyond(beyond)}) >= 0.0;
}

/// The mode behind the moment at which one ceases to hold; a speed that has passed zero becomes zero.
template <class Acceleration>
Mode mode_behind(Mode mode, double& speed, double beyond, const Acceleration& acceleration) {
  const bool stops = mode.motion != Motion::stuck && sign(mode.motion) * speed <= 0.0;
  if (stops) speed = 0.0;
  if (stops || mode.motion == Motion::stuck) return mode_from_rest(beyond, acceleration);
  return {mode.motion, mode.flank == Flank::left ? Flank::right : Flank::left};
}

/// Follows a motion over a duration by steps, each cut where the mode ceases to hold: moved(s) is the state a time s
/// behind t, holds(t, x) whether the mode holds there, and change() takes the next mode; it ends the motion by false.
template <class State, class Moved, class Holds, class Change>
void follow(double duration, double step, double& t, State& now, const Moved& moved, const Holds& holds,
            const Change& change) {
  for (double left = duration; left > 0.0;) {
    const double h = std::min(step, left);
    if (const State then = moved(h); holds(t + h, then)) {
      now = then;
      t += h;
      left -= h;
      continue;
    }
    const double passed = end_of(0.0, h, [&](double s) { return holds(t + s, moved(s)); });
    now = moved(passed);
    t += passed;
    left = duration - t;
    if (!change()) return;
  }
}

}  // namespace wormdrive::test
