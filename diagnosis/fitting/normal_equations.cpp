#include "diagnosis/fitting/normal_equations.hpp"

#include <algorithm>
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

NormalEquations::NormalEquations(const Eigen::MatrixXf& J, const Eigen::VectorXd& residual)
    : A(Eigen::MatrixXd::Zero(J.cols(), J.cols())), b(Eigen::VectorXd::Zero(J.cols())) {
  for (Eigen::Index begin = 0; begin < J.rows(); begin += rows_of_part) {
    const Eigen::Index rows = std::min(rows_of_part, J.rows() - begin);
    const Eigen::MatrixXd part = J.middleRows(begin, rows).cast<double>();
    A.noalias() += part.transpose() * part;
    b.noalias() -= part.transpose() * residual.segment(begin, rows);
  }
}

Eigen::VectorXd solve_normal(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double damping) {
  Eigen::MatrixXd damped = A;
  damped.diagonal() += damping * A.diagonal() + Eigen::VectorXd::Constant(A.rows(), 1e-12);
  return damped.ldlt().solve(b);
}

}  // namespace wormdrive
