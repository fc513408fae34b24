#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "statistics/normal.hpp"

namespace wormdrive {

/// The lower triangle L with L L^T = matrix; nothing unless the matrix is positive definite. In plain sums, so that it
/// has the same bits on every machine.
inline std::optional<Eigen::MatrixXd> lower_factor(const Eigen::MatrixXd& matrix) {
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(matrix.rows(), matrix.cols());
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (Eigen::Index k = 0; k <= row; ++k) {
      double left = matrix(row, k);
      for (Eigen::Index j = 0; j < k; ++j) left -= factor(row, j) * factor(k, j);
      if (k == row && !(left > 0.0)) return std::nullopt;
      factor(row, k) = k == row ? std::sqrt(left) : left / factor(k, k);
    }
  return factor;
}

/// Makes independent points of the unit cube dependent, each coordinate remaining uniform: a Gaussian copula.
class Copula {
 public:
  /// Every coordinate on its own.
  Copula() = default;
  /// matrix: correlation of the normal scores, with ones on the diagonal, for which exists().
  explicit Copula(const Eigen::MatrixXd& matrix) : factor_(lower_factor(matrix).value()) {}

  /// Whether such correlations can be: the matrix is positive definite, and stays so in any order in spite of rounding.
  static bool exists(const Eigen::MatrixXd& matrix);
  bool independent() const { return factor_.size() == 0; }
  std::size_t size() const { return static_cast<std::size_t>(factor_.rows()); }

  /// The coordinates that hang on another one, or another one on them.
  std::vector<std::size_t> dependent() const {
    std::vector<std::size_t> list;
    for (Eigen::Index k = 0; k < factor_.rows(); ++k)
      if (factor_(k, k) != 1.0 || factor_.col(k).tail(factor_.rows() - k - 1).any())
        list.push_back(static_cast<std::size_t>(k));
    return list;
  }
  /// The same for coordinates in another order: each of these then hangs on those before it. order: of all of them.
  Copula reordered(const std::vector<std::size_t>& order) const {
    if (independent()) return {};
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(factor_.rows(), factor_.cols());
    for (Eigen::Index row = 0; row < matrix.rows(); ++row)
      for (Eigen::Index k = 0; k < row; ++k) {
        const auto a = static_cast<Eigen::Index>(order[static_cast<std::size_t>(row)]),
                   b = static_cast<Eigen::Index>(order[static_cast<std::size_t>(k)]);
        for (Eigen::Index j = 0; j <= std::min(a, b); ++j) matrix(row, k) += factor_(a, j) * factor_(b, j);
        matrix(k, row) = matrix(row, k);
      }
    return Copula(matrix);
  }
  /// The lower triangle of the correlations between dependent coordinates.
  Eigen::MatrixXd factor(const std::vector<std::size_t>& coordinates) const {
    return factor_(coordinates, coordinates);
  }

  void apply(std::vector<double>& u) const {
    if (independent()) return;
    const std::vector<double> z = scores(u);
    for (Eigen::Index k = 0; k < factor_.rows(); ++k) {
      if (factor_(k, k) == 1.0) continue;  // its own: not a bit of it changes
      double score = 0.0;
      for (Eigen::Index j = 0; j <= k; ++j) score += factor_(k, j) * z[static_cast<std::size_t>(j)];
      u[static_cast<std::size_t>(k)] = probability(score);
    }
  }
  /// The independent point that apply() would take to this one.
  void undo(std::vector<double>& u) const {
    if (independent()) return;
    std::vector<double> z = scores(u);
    for (Eigen::Index k = 0; k < factor_.rows(); ++k) {
      if (factor_(k, k) == 1.0) continue;
      double& score = z[static_cast<std::size_t>(k)];
      for (Eigen::Index j = 0; j < k; ++j) score -= factor_(k, j) * z[static_cast<std::size_t>(j)];
      score /= factor_(k, k);
      u[static_cast<std::size_t>(k)] = probability(score);
    }
  }

 private:
  static std::vector<double> scores(const std::vector<double>& u) {
    std::vector<double> z(u.size());
    for (std::size_t k = 0; k < u.size(); ++k) z[k] = normal_quantile(u[k]);
    return z;
  }
  static double probability(double score) { return std::clamp(normal_probability(score), 0x1p-54, 1.0 - 0x1p-53); }

  Eigen::MatrixXd factor_;  ///< lower triangle
};

}  // namespace wormdrive
