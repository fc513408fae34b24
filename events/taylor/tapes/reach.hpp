#pragma once

namespace wormdrive {

/// How far a step may follow the torque of a motor [s]: a leap, and the disc of complex times around its begin, which
/// is no more than so many leaps wide.
template <class V>
struct CommandReach {
  V leap, disc;
  double leaps_in_disc;
};
/// A torque that follows its command with a lag [s], so long after that came [s]. At the edge of the disc what is left
/// of the torque before is e^2.25 of what it was at the command: the less it is now, the further a leap gets.
template <class V>
[[gnu::always_inline]] inline CommandReach<V> reach_of_lag(const V& lag, const V& elapsed) {
  constexpr double leaps_in_disc = 4.0;  // so far 20 terms are exact
  const V disc = 2.25 * lag + elapsed;
  return {(1.0 / leaps_in_disc) * disc, disc, leaps_in_disc};
}

}  // namespace wormdrive
