#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "sweep/normal.hpp"

namespace wormdrive {

/// Makes independent points of the unit cube dependent, each coordinate remaining uniform: a Gaussian copula.
class Copula {
 public:
  /// Every coordinate on its own.
  Copula() = default;
  /// matrix: correlation of the normal scores, with ones on the diagonal.
  explicit Copula(const Eigen::MatrixXd& matrix) : factor_(Eigen::LLT<Eigen::MatrixXd>(matrix).matrixL()) {}

  /// Whether such correlations can be: the matrix is positive definite.
  static bool exists(const Eigen::MatrixXd& matrix) {
    return Eigen::LLT<Eigen::MatrixXd>(matrix).info() == Eigen::Success;
  }
  bool independent() const { return factor_.size() == 0; }

  void apply(std::vector<double>& u) const {
    if (independent()) return;
    std::vector<double> z(u.size());
    for (std::size_t k = 0; k < u.size(); ++k) z[k] = normal_quantile(u[k]);
    for (Eigen::Index k = 0; k < factor_.rows(); ++k) {
      if (factor_(k, k) == 1.0) continue;  // its own: not a bit of it changes
      double score = 0.0;
      for (Eigen::Index j = 0; j <= k; ++j) score += factor_(k, j) * z[static_cast<std::size_t>(j)];
      u[static_cast<std::size_t>(k)] = std::clamp(normal_probability(score), 0x1p-54, 1.0 - 0x1p-53);
    }
  }

 private:
  Eigen::MatrixXd factor_;  ///< lower triangle
};

}  // namespace wormdrive
