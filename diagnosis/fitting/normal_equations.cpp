#include "diagnosis/fitting/normal_equations.hpp"

#include <cmath>

#include <Eigen/Cholesky>

namespace wormdrive {

WeightedColumns::WeightedColumns(std::span<const double> weights) {
  for (std::size_t k = 0; k < weights.size(); ++k)
    if (weights[k] > 0.0) {
      rows_.push_back(k);
      root_.push_back(std::sqrt(weights[k]));
    }
}

Eigen::VectorXd solve_normal(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double damping) {
  Eigen::MatrixXd damped = A;
  damped.diagonal() += damping * A.diagonal() + Eigen::VectorXd::Constant(A.rows(), 1e-12);
  return damped.ldlt().solve(b);
}

}  // namespace wormdrive
