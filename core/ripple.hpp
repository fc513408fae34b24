#pragma once
#include <algorithm>
#include <cmath>

#include "core/mode.hpp"
#include "core/numbers/jet.hpp"
#include "core/states/state_rates.hpp"

namespace wormdrive {

/// How fast the phase of what depends on an angle passes in a state of motion [rad/s]: the swing of an arm, cogging,
/// the runout of the gear. 0 for a system whose torques do not depend on an angle periodically.
template <class System>
double ripple_rate(const System& system, const typename System::State& x) {
  using std::abs;
  if constexpr (requires { system.rigid(); })
    return system.rigid().ripple() * std::max(abs(x[1] / system.mesh().i), abs(x[3]));
  else if constexpr (requires { system.ripple(), system.effects(); } && System::state_size > 2)
    return system.ripple() * std::max<double>(abs(x[1]), abs(load_speed(system.effects(), x)));
  else if constexpr (requires { system.ripple(); })
    return system.ripple() * abs(x[1]);
  else
    return 0.0;
}

/// Highest angular frequency of the present inputs from a moment on, of what effects do over the time, and at rest of
/// what changes with the time there [rad/s].
template <class System>
double fastest_change(const System& system, const typename System::Instant& now) {
  double most = system.fastest_input(now.t);
  if constexpr (requires { system.effects().fastest_in_time(); })
    most = std::max(most, system.effects().fastest_in_time());
  if constexpr (requires { system.effects(), now.since, now.mode.motion; })
    if (now.mode.motion == Motion::stuck)
      most = std::max(most, system.effects().fastest_at_rest(now.t - value_of(now.since)));
  return most;
}

}  // namespace wormdrive
