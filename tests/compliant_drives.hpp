#pragma once
// What the tests of the compliant drive share: drives, contacts and an integration of their own.
#include <array>
#include <cmath>

#include "core/elastic/compliant_drive.hpp"
#include "support.hpp"

namespace wormdrive::test {

using ElasticDrive = CompliantDrive<double, SummedLoad>;
inline ElasticDrive compliant(const MeshParameters<double>& p, const LoadParameters& load, const Signal& motor,
                              const ToothContact<double>& contact, Effects<double> on = {}) {
  return {drive(p, sum_of(load), motor, std::move(on)), contact};
}
extern WORMDRIVE_TEST_RUN(ElasticDrive);

/// A frictionless gear with a ratio of 1 whose teeth have a lever arm of 1 m on both shafts.
inline MeshParameters<double> unit_arms(double Jw, double Jg) {
  const double radius = std::sqrt(2.0);
  return {.i = 1, .lambda = 45 * unit::degree, .phi_n = 0, .lw = radius, .lg = radius, .mu = 0, .Jw = Jw, .Jg = Jg};
}

/// The inertia of a worm shaft that nothing moves [kg m^2].
inline constexpr double clamped_shaft = 1e30;

/// One step of the classical Runge-Kutta method of order 4.
template <std::size_t N, class F>
void runge_kutta_step(F&& f, double t, std::array<double, N>& x, double h) {
  const auto moved = [&](double dt, const std::array<double, N>& rate) {
    std::array<double, N> y = x;
    for (std::size_t k = 0; k < N; ++k) y[k] += dt * rate[k];
    return y;
  };
  const auto a = f(t, x), b = f(t + h / 2, moved(h / 2, a)), c = f(t + h / 2, moved(h / 2, b)),
             d = f(t + h, moved(h, c));
  for (std::size_t k = 0; k < N; ++k) x[k] += h / 6 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]);
}

/// A step that ends and goes on where the law changes its formula, found by bisection: across such a bend a step of
/// Runge-Kutta is only of order 2. region(x) numbers the formulas; crossed(t, x) is told when and where.
template <std::size_t N, class F, class Region, class Crossed>
void piecewise_step(F&& f, Region&& region, Crossed&& crossed, double t, std::array<double, N>& x, double h) {
  std::array<double, N> y = x;
  runge_kutta_step(f, t, y, h);
  if (region(y) == region(x)) {
    x = y;
    return;
  }
  double before = 0.0, behind = h;
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (before + behind);
    y = x;
    runge_kutta_step(f, t, y, middle);
    (region(y) == region(x) ? before : behind) = middle;
  }
  y = x;
  runge_kutta_step(f, t, y, behind);
  crossed(t + behind, y);
  x = y;
  runge_kutta_step(f, t + behind, x, h - behind);
}

}  // namespace wormdrive::test
