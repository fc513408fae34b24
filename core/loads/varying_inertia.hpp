#pragma once
#include <algorithm>

#include "core/numbers/jet.hpp"

namespace wormdrive {

/// An inertia [kg m^2] that depends on the angle, and its slope over it [kg m^2/rad].
template <class S>
struct VaryingInertia {
  S inertia, slope;
};

/// The greatest inertia within a way of the gear from 0 on [kg m^2]: between 10 000 angles of half a turn it is missed
/// by a share of 1e-7.
template <class Effect>
double greatest_inertia_within(const Effect& effect, double way) {
  constexpr int angles = 10'000;
  double most = 0.0;
  for (int k = 0; k < angles; ++k) most = std::max(most, value_of(effect.inertia_at(k * way / angles).inertia));
  return most;
}

}  // namespace wormdrive
