#pragma once
#include <array>
#include <cstddef>

#include "core/numbers/rounded.hpp"
#include "events/timetable.hpp"

namespace wormdrive {

/// Systems that say how the motion goes on from a moment, with the rounding of every derivative.
template <class System>
concept Foresees = requires(const System& system, const typename System::Instant& now) {
  system.template ahead<4, Rounded>(now);
};

/// How many shafts move on their own; the first states are their angles and speeds in turn.
template <class System>
constexpr int shaft_count() {
  if constexpr (requires { System::shaft_count; })
    return System::shaft_count;
  else
    return System::state_size / 2;
}

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

/// The guards where a segment starts.
template <std::size_t count>
struct GuardStarts {
  std::array<double, count> floor{};  ///< what is added to each, so that those that start at zero start positive
  int fallen = no_guard;              ///< one that is over at once
};
template <class System, class Guard, std::size_t count>
GuardStarts<count> guard_starts(const System& system, const typename System::Instant& now,
                                const std::array<Guard, count>& at_start) {
  GuardStarts<count> starts;
  for (std::size_t g = 0; g < count; ++g) {
    if (at_start[g][0] > 0.0) continue;
    const GuardStart start = guard_start(system, now, static_cast<int>(g), at_start[g]);
    starts.floor[g] = start.floor;
    if (start.falls && starts.fallen == no_guard) starts.fallen = static_cast<int>(g);
  }
  return starts;
}

/// Phase [rad] of the fastest input, or of what swings with an angle, from one look at the guards to the next: so small
/// that a guard turns at most once in between. At rest nothing but these looks tells what the torques do.
inline double phase_between_looks(bool at_rest) { return at_rest ? 0.05 : 0.25; }

/// So many times the rounding of what the equations give at a start, series that begin there may be wrong on their way.
inline constexpr double roundings_of_series = 16.0;

}  // namespace wormdrive
