#pragma once
#include <cmath>
#include <optional>

#include <Eigen/LU>

namespace wormdrive {

/// A step of the implicit Runge-Kutta method Radau IIA of order 5, for what settles much faster than the step is long.
///
/// Calls at_stage(instant, weight [s]) for the three stages of its quadrature. h in s, J about the Jacobian of the
/// derivative within the step. Nothing where Newton's method does not solve its equations with J: the caller takes a
/// shorter step.
/// Source: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed., Springer 1996, section IV.5,
/// IV.8.
template <class System, class AtStage>
std::optional<typename System::State> implicit_step(const System& system, const typename System::Instant& now, double h,
                                                    const typename System::Jacobian& J, AtStage&& at_stage) {
  using State = typename System::State;
  constexpr int n = System::state_size, most_iterations = 10;
  using Stages = Eigen::Matrix<double, n, 3>;
  static const double r = std::sqrt(6.0);
  static const Eigen::Vector3d c{(4.0 - r) / 10.0, (4.0 + r) / 10.0, 1.0};
  static const Eigen::Matrix3d A{{(88.0 - 7.0 * r) / 360.0, (296.0 - 169.0 * r) / 1800.0, (-2.0 + 3.0 * r) / 225.0},
                                 {(296.0 + 169.0 * r) / 1800.0, (88.0 + 7.0 * r) / 360.0, (-2.0 - 3.0 * r) / 225.0},
                                 {(16.0 - r) / 36.0, (16.0 + r) / 36.0, 1.0 / 9.0}};

  Eigen::Matrix<double, 3 * n, 3 * n> equations;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) equations.template block<n, n>(n * i, n * j) = -h * A(i, j) * J;
  equations.diagonal().array() += 1.0;
  const Eigen::PartialPivLU<decltype(equations)> solve(equations);

  Stages increments = Stages::Zero();
  // Of each state by itself: a current of amperes says nothing of a speed.
  State size = now.x.cwiseAbs();
  double last = 0.0;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    Stages rates;
    for (int i = 0; i < 3; ++i) rates.col(i) = system.derivative(now.t + c[i] * h, now.x + increments.col(i), now.mode);
    const Stages missing = h * rates * A.transpose() - increments;
    Eigen::Matrix<double, 3 * n, 1> correction;
    correction = solve.solve(Eigen::Map<const Eigen::Matrix<double, 3 * n, 1>>(missing.data()));
    const Stages change = Eigen::Map<const Stages>(correction.data());
    increments += change;
    if (!increments.allFinite()) return std::nullopt;
    for (int i = 0; i < 3; ++i) size = size.cwiseMax((now.x + increments.col(i)).cwiseAbs());
    double share = 0.0;
    for (int k = 0; k < n; ++k)
      if (size[k] > 0.0) share = std::max(share, change.row(k).cwiseAbs().maxCoeff() / size[k]);
    if (share <= 1e-14 || (share <= 1e-11 && iteration > 0 && share >= 0.5 * last)) {  // as near as rounding lets it
      for (int i = 0; i < 3; ++i)
        at_stage(typename System::Instant{now.t + c[i] * h, now.x + increments.col(i), now.mode}, h * A(2, i));
      return now.x + increments.col(2);
    }
    if (iteration > 1 && share > 0.5 * last) return std::nullopt;
    last = share;
  }
  return std::nullopt;
}

}  // namespace wormdrive
