#pragma once
#include <cmath>

#include <Eigen/Core>

namespace wormdrive {

/// The largest real part of the eigenvalues of a Jacobian [1/s].
double largest_growth(const Eigen::Matrix4d& J);
double largest_growth(const Eigen::Matrix3d& J);
inline double largest_growth(const Eigen::Matrix2d& J) {  // of rows (0, 1) and (a, b)
  const double half = 0.5 * J(1, 1), root = half * half + J(1, 0);
  return root > 0.0 ? half + std::sqrt(root) : half;
}

/// How fast the motion departs from one beside it [1/s].
template <class System>
double growth(const System& system, const typename System::Instant& now) {
  const typename System::Jacobian J = system.jacobian(now.t, now.x, now.mode);
  return J.allFinite() ? largest_growth(J) : 0.0;  // what is not finite the integrator meets next, and says
}

}  // namespace wormdrive
