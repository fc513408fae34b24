#pragma once
#include <array>

#include "core/rounded.hpp"

namespace wormdrive {

/// Systems that say how the motion goes on from a moment, with the rounding of every derivative.
template <class System>
concept Foresees = requires(const System& system, const typename System::Instant& now) {
  system.template ahead<4, Rounded>(now);
};

/// The guards along the motion from now on as power series of order N, with their rounding.
template <int N, Foresees System>
auto guard_series(const System& system, const typename System::Instant& now) {
  return system.guards(system.template ahead<N, Rounded>(now), now.mode);
}

/// What a guard that is not positive at the start of a segment does just after it.
struct GuardStart {
  bool falls = false;  ///< it is over at once
  double floor = 0.0;  ///< of its rounding: it has fallen through zero when it is that far below
};

/// Judges a guard at the start of a segment by the first of its derivatives that is more than rounding. A system that
/// does not foresee its motion is judged by value and rate alone.
template <class System, class Guard>
GuardStart guard_start(const System& system, const typename System::Instant& now, int guard, const Guard& at_start) {
  if constexpr (Foresees<System>) {
    const auto ahead = guard_series<4>(system, now)[guard];
    const double resolution = time_resolution(now.t);
    // twice as far below zero there is no doubt that it has fallen
    return {sign_just_after(ahead, resolution) < 0, 2.0 * blur(ahead, 0, resolution)};
  } else {
    return {at_start[0] <= 0.0 && at_start[1] < 0.0, 0.0};
  }
}

}  // namespace wormdrive
