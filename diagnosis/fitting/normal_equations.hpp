#pragma once
#include <span>
#include <vector>

#include <Eigen/Core>

namespace wormdrive {

/// Changes of whitened innovations, one column per cause, weighted and reduced to the fitted samples.
class WeightedColumns {
 public:
  /// weights: curvature of every sample, 0 where it is not fitted.
  explicit WeightedColumns(std::span<const double> weights);

  Eigen::VectorXd operator()(std::span<const double> column) const;

 private:
  std::vector<std::size_t> rows_;
  std::vector<double> root_;
};

/// Solves A x = b for a positive A that may be singular to rounding; in the columns' own sizes.
Eigen::VectorXd solve_normal(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double damping = 1e-9);

}  // namespace wormdrive
