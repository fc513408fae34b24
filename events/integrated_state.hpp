#pragma once
#include "core/mode.hpp"

namespace wormdrive {

/// Two shafts whose teeth give way, so that all forces between them hang on a small difference of their angles.
template <class System>
concept HasElasticTeeth = requires(const System& system) {
  system.contact();
};

// What CVODE integrates: the state, of elastic teeth with the deflection, theta_g - theta_w / i, and its rate in place
// of the gear's angle and speed. CVODE weighs the error of each number by itself, and a tolerated share of an angle may
// be thousands of times the deflection. Its formulas are linear, so that they do the same to either choice.

/// y, of a state.
template <class System>
typename System::State integrated_state(const System& system, typename System::State x) {
  if constexpr (HasElasticTeeth<System>) x.template tail<2>() -= x.template head<2>() / system.mesh().i;
  return x;
}

/// The state, of y; a gear that is stuck is where it was at an earlier instant of the mode, to the last digit.
template <class System>
typename System::State state_of_integrated(const System& system, typename System::State y,
                                           const typename System::Instant& earlier) {
  if constexpr (HasElasticTeeth<System>) {
    if (earlier.mode.gear == Motion::stuck)
      y.template tail<2>() = earlier.x.template tail<2>();
    else
      y.template tail<2>() += y.template head<2>() / system.mesh().i;
  }
  return y;
}

/// Derivatives of y' to y, of those of x' to x.
template <class System>
typename System::Jacobian integrated_jacobian(const System& system, typename System::Jacobian J) {
  if constexpr (HasElasticTeeth<System>) {
    const double i = system.mesh().i;
    J.template leftCols<2>() += J.template rightCols<2>() / i;
    J.template bottomRows<2>() -= J.template topRows<2>() / i;
  }
  return J;
}

}  // namespace wormdrive
