#pragma once
#include "core/elastic/compliant_start.hpp"
#include "core/initial_state.hpp"

namespace wormdrive {

/// That of rigid teeth; the states of effects begin at 0.
template <class Drive>
typename Drive::State rigid_state(const InitialState<double>& initial) {
  typename Drive::State x = Drive::State::Zero();
  x.template head<2>() << initial.theta_g, initial.omega_g;
  return x;
}

/// The state in which a drive starts that has entered t [s]: elastic teeth carry the load already.
template <class Drive>
typename Drive::State start_state(const Drive& drive, const InitialState<double>& initial, double t) {
  if constexpr (requires { carrying(drive, t, 0.0, 0.0); })
    return carrying(drive, t, initial.theta_g, initial.omega_g);
  else
    return rigid_state<Drive>(initial);
}

}  // namespace wormdrive
