#pragma once
#include <array>

#include <ceres/jet.h>

#include "core/mode.hpp"

namespace wormdrive {

/// Exact Jacobian of a drive's derivative, by automatic differentiation: it stays right whatever effects are on.
template <class Drive>
typename Drive::Jacobian state_jacobian(const Drive& drive, double t, const typename Drive::State& x, Mode mode) {
  constexpr int size = Drive::state_size;
  using Jet = ceres::Jet<double, size>;
  std::array<Jet, size> state;
  for (int k = 0; k < size; ++k) state[k] = Jet(x[k], k);
  const auto at = drive.moment_at(Jet(t), state);
  const Jet a = drive.acceleration(at, mode);
  typename Drive::Jacobian J = Drive::Jacobian::Zero();
  if (mode.motion != Motion::stuck) {
    J(0, 1) = 1.0;
    J.row(1) = a.v.transpose();
  }
  if constexpr (size > 2) {
    const auto of_effects = drive.state_rates(at, mode);
    for (int k = 2; k < size; ++k) J.row(k) = of_effects[k - 2].v.transpose();
    if (mode.motion == Motion::stuck) J.template leftCols<2>().setZero();  // or pivoting would round the speed off 0
  }
  return J;
}

}  // namespace wormdrive
