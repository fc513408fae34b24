#pragma once
#include <algorithm>

#include "core/elastic/compliant_start.hpp"
#include "core/initial_state.hpp"
#include "core/worm_drive.hpp"

namespace wormdrive {

/// The state in which a drive starts that has entered t [s]: elastic teeth carry the load already, and effects have the
/// states in which they are in balance with the drive.
template <class Drive>
typename Drive::State starting_state(const Drive& drive, const InitialState<typename Drive::State::Scalar>& initial,
                                     double t) {
  using T = typename Drive::State::Scalar;
  if constexpr (requires { carrying(drive, t, 0.0, 0.0); }) {
    return carrying(drive, t, initial.theta_g, initial.omega_g);
  } else {
    typename Drive::State x = Drive::State::Constant(T(0.0));
    x[0] = initial.theta_g;
    x[1] = initial.omega_g;
    if constexpr (Drive::state_size > 2) {
      const auto of_effects =
          starting_states(drive.effects(), drive.load(), drive.moment(T(t), initial.theta_g, initial.omega_g));
      std::copy(of_effects.begin(), of_effects.end(), x.data() + 2);
    }
    return x;
  }
}

}  // namespace wormdrive
