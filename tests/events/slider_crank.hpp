#pragma once
#include <cmath>
#include <complex>

#include "core/effects/load_crank.hpp"

namespace wormdrive::test {

// What a shaft feels of the mass on a crank, for judges: from the geometry alone, without its formulas of rates.

/// Where the mass is [m].
template <class X>
X way(const LoadCrank<double>& c, const X& theta_g) {
  const X p = theta_g + c.shift, across = c.crank * std::sin(p);
  return c.crank * std::cos(p) + (c.rod ? std::sqrt(*c.rod * *c.rod - across * across) : X(0.0));
}
/// The inertia [kg m^2], from the rate of the way by a complex step.
inline double inertia(const LoadCrank<double>& c, double theta_g) {
  constexpr double h = 1e-30;
  const double rate = way(c, std::complex<double>(theta_g, h)).imag() / h;
  return c.mass * rate * rate;
}
/// Half its slope over the angle, by a difference of sixth order.
inline double half_slope(const LoadCrank<double>& c, double theta_g) {
  constexpr double h = 1e-3;
  const auto at = [&](double x) { return inertia(c, theta_g + x); };
  return 0.5 * (45.0 * (at(h) - at(-h)) - 9.0 * (at(2.0 * h) - at(-2.0 * h)) + (at(3.0 * h) - at(-3.0 * h))) /
         (60.0 * h);
}

}  // namespace wormdrive::test
