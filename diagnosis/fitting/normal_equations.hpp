#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace wormdrive {

/// Rows whose products are worked out at a time: for all at once a copy of the columns would take as much memory as
/// they.
inline constexpr Eigen::Index rows_of_part = 4096;

/// Changes of whitened innovations, one column per cause, weighted and reduced to the fitted samples.
class WeightedColumns {
 public:
  /// weights: curvature of every sample, 0 where it is not fitted.
  explicit WeightedColumns(std::span<const double> weights);

  /// How many samples are fitted.
  Eigen::Index rows() const { return static_cast<Eigen::Index>(rows_.size()); }
  Eigen::VectorXd operator()(const std::vector<double>& column) const { return (*this)(column, 0, rows()); }
  /// So many rows of it.
  template <class Number>
  Eigen::VectorXd operator()(const std::vector<Number>& column, Eigen::Index begin, Eigen::Index rows) const {
    Eigen::VectorXd weighted(rows);
    for (Eigen::Index q = 0; q < rows; ++q) {
      const auto at = static_cast<std::size_t>(begin + q);
      weighted[q] = root_[at] * column[rows_[at]];
    }
    return weighted;
  }

 private:
  std::vector<std::size_t> rows_;
  std::vector<double> root_;
};

/// Calls visit(block, first, rows) for every stretch of rows of one block.
template <class Visit>
void for_each_stretch(std::span<const std::uint32_t> block_of, Visit&& visit) {
  for (std::size_t begin = 0, end = 0; begin < block_of.size(); begin = end) {
    while (end < block_of.size() && block_of[end] == block_of[begin]) ++end;
    visit(block_of[begin], static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end - begin));
  }
}

/// Of columns that are kept in floats, A = J^T J and b = -J^T residual, worked out part by part in doubles.
struct NormalEquations {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;

  NormalEquations(const Eigen::MatrixXf& J, const Eigen::VectorXd& residual);
};

/// Solves A x = b for a positive A that may be singular to rounding; in the columns' own sizes.
Eigen::VectorXd solve_normal(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double damping = 1e-9);

}  // namespace wormdrive
