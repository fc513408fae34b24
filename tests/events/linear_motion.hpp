#pragma once
#include <cmath>
#include <complex>

#include <Eigen/LU>

namespace wormdrive::test {

/// x(t) of x' = A x + c from x(0), by the formula for two states.
inline Eigen::Vector2d linear_motion(const Eigen::Matrix2d& A, const Eigen::Vector2d& c, const Eigen::Vector2d& start,
                                     double t) {
  const Eigen::Vector2d rest = -A.inverse() * c;
  const double s = 0.5 * A.trace();
  const std::complex<double> q = std::sqrt(std::complex<double>(s * s - A.determinant()));
  const double cosh = std::real(std::cosh(q * t)), sinh = std::real(std::sinh(q * t) / q);
  const Eigen::Matrix2d e =
      std::exp(s * t) * (cosh * Eigen::Matrix2d::Identity() + sinh * (A - s * Eigen::Matrix2d::Identity()));
  return rest + e * (start - rest);
}

}  // namespace wormdrive::test
