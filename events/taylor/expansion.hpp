#pragma once
#include <array>
#include <cstddef>

#include "events/taylor/polynomial.hpp"

namespace wormdrive {

/// The motion over one step: gear angle [rad], gear speed [rad/s], guards and the states of effects as polynomials.
template <int guard_count, int effect_states = 0>
struct Expansion {
  int order = 0;      ///< of speed and guards; the angle has one more
  double step = 0.0;  ///< over which they are accurate [s]
  Coefficients theta{}, omega{};
  std::array<Coefficients, guard_count> guards{};
  std::array<Coefficients, effect_states> states{};
  std::array<bool, guard_count> positive{};  ///< the guard certainly stays positive over the step

  Polynomial angle() const { return {theta.data(), static_cast<std::size_t>(order) + 2}; }
  Polynomial speed() const { return {omega.data(), static_cast<std::size_t>(order) + 1}; }
  Polynomial state(int k) const { return {states[k].data(), static_cast<std::size_t>(order) + 1}; }
  Polynomial guard(int g) const { return {guards[g].data(), static_cast<std::size_t>(order) + 1}; }
};

}  // namespace wormdrive
