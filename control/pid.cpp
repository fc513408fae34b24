#include "control/pid.hpp"

#include <algorithm>
#include <complex>

#include <Eigen/LU>

#include "core/numbers/eigenvalues.hpp"
#include "core/numbers/portable.hpp"

namespace wormdrive {

// From the stable subspace of the Hamiltonian matrix. Time is counted in 1/p and torque in M p^2, p being the fastest
// pole that one weight alone asks for: the matrix then has no number above 1, whatever the weights are.
PidGains lqr_gains(const PidParameters& weights, double M) {
  const double torque = weights.torque_weight * M * M;
  const double rate = weights.integral_weight / torque;
  const double p =
      std::max({rate > 0.0 ? portable::pow(rate, 1.0 / 6.0) : 0.0, std::sqrt(std::sqrt(weights.angle_weight / torque)),
                std::sqrt(weights.speed_weight / torque)});
  const double p2 = p * p;
  Eigen::Matrix<double, 6, 6> hamiltonian = Eigen::Matrix<double, 6, 6>::Zero();
  hamiltonian(0, 1) = hamiltonian(1, 2) = 1.0;
  hamiltonian(2, 5) = -1.0;
  hamiltonian(3, 0) = -weights.integral_weight / (torque * p2 * p2 * p2);
  hamiltonian(4, 1) = -weights.angle_weight / (torque * p2 * p2);
  hamiltonian(5, 2) = -weights.speed_weight / (torque * p2);
  hamiltonian(4, 3) = hamiltonian(5, 4) = -1.0;
  const auto [values, vectors] = eigenpairs(hamiltonian);
  Eigen::Matrix3cd X, Y;
  int stable = 0;
  for (int k = 0; k < 6 && stable < 3; ++k) {
    if (!(values[k].real() < 0.0)) continue;
    X.col(stable) = vectors.col(k).head<3>();
    Y.col(stable++) = vectors.col(k).tail<3>();
  }
  if (stable < 3) return {};  // no gains: stabilises() says no
  const Eigen::Matrix3d P = (Y * X.inverse()).real();
  return {P(2, 0) * M * p * p * p, P(2, 1) * M * p * p, P(2, 2) * M * p};
}

}  // namespace wormdrive
