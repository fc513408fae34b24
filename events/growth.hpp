#pragma once
#include <cmath>

#include <Eigen/Eigenvalues>

namespace wormdrive {

/// How fast the motion departs from one beside it [1/s]: the largest real part of the eigenvalues of its Jacobian.
template <class System>
double growth(const System& system, const typename System::Instant& now) {
  const typename System::Jacobian J = system.jacobian(now.t, now.x, now.mode);
  if (!J.allFinite()) return 0.0;  // what the integrator meets next, and says
  if constexpr (System::state_size == 2) {
    // rows (0, 1) and (a, b)
    const double half = 0.5 * J(1, 1), root = half * half + J(1, 0);
    return root > 0.0 ? half + std::sqrt(root) : half;
  } else {
    return J.eigenvalues().real().maxCoeff();
  }
}

}  // namespace wormdrive
