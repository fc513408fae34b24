#pragma once
#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "core/numbers/eigenvalues.hpp"

namespace wormdrive {

/// The largest real part of the eigenvalues of a Jacobian [1/s].
template <int n>
double largest_growth(const Eigen::Matrix<double, n, n>& J) {
  static_assert(n <= most_rows);
  return eigenvalues(J).real().maxCoeff();
}
inline double largest_growth(const Eigen::Matrix2d& J) {  // of rows (0, 1) and (a, b)
  const double half = 0.5 * J(1, 1), root = half * half + J(1, 0);
  return root > 0.0 ? half + std::sqrt(root) : half;
}

/// The largest magnitude of the eigenvalues of a Jacobian [1/s]: an explicit method has to follow it.
template <int n>
double fastest_rate(const Eigen::Matrix<double, n, n>& J) {
  static_assert(n <= most_rows);
  return eigenvalues(J).cwiseAbs().maxCoeff();
}
inline double fastest_rate(const Eigen::Matrix2d& J) {
  const double half = 0.5 * J(1, 1), root = half * half + J(1, 0);
  return root > 0.0 ? std::abs(half) + std::sqrt(root) : std::sqrt(-J(1, 0));
}

/// How fast the motion departs from one beside it [1/s].
template <class System>
double growth(const System& system, const typename System::Instant& now) {
  const typename System::Jacobian J = system.jacobian(now.t, now.x, now.mode);
  return J.allFinite() ? largest_growth(J) : 0.0;  // what is not finite the integrator meets next, and says
}

/// A longest step [s] short enough for a motion that grows. Friction that falls over the speed makes a motion unstable.
/// In steps that are long against its growth an implicit formula damps it, and its own estimate of the error finds
/// nothing wrong. Friction may rest at the start of a step, where the load passes through zero, and grow on its way, so
/// both ends count; past limit [s] nothing is evaluated. Looks are counted in jacobians.
template <class System>
double shortened_by_growth(const System& system, const typename System::Instant& now, double step, double limit,
                           long& jacobians) {
  constexpr double growth_in_a_step = 0.25;  // exponent, well within what formulas of low order follow
  const auto grows_in = [&](double s) {
    ++jacobians;
    typename System::Instant then = now;
    then.t += std::min(s, limit - now.t);
    return growth(system, then);
  };
  if (const double rate = grows_in(0.0); rate > 0.0) step = std::min(step, growth_in_a_step / rate);
  while (std::isfinite(step) && grows_in(step) * step > growth_in_a_step) step *= 0.5;
  return step;
}

}  // namespace wormdrive
