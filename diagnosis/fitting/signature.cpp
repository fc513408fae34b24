#include "diagnosis/fitting/signature.hpp"

#include <Eigen/QR>

namespace wormdrive {
namespace {

/// Others below the signature's own rows; a tolerance is one more datum, that its parameter is zero.
Eigen::MatrixXd stacked(const std::vector<std::vector<double>>& columns, const std::vector<double>& tolerances) {
  const auto rows = static_cast<Eigen::Index>(columns.front().size()), n = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows + n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    A.col(k).head(rows) = Eigen::Map<const Eigen::VectorXd>(columns[static_cast<std::size_t>(k)].data(), rows);
    if (!tolerances.empty() && tolerances[static_cast<std::size_t>(k)] > 0.0)
      A(rows + k, k) = 1.0 / tolerances[static_cast<std::size_t>(k)];
    if (const double norm = A.col(k).norm(); norm > 0.0) A.col(k) /= norm;
  }
  return A;
}

}  // namespace

double distinct(const std::vector<double>& signature, const std::vector<std::vector<double>>& others,
                const std::vector<double>& tolerances) {
  const auto rows = static_cast<Eigen::Index>(signature.size());
  const Eigen::Map<const Eigen::VectorXd> own(signature.data(), rows);
  if (others.empty()) return own.squaredNorm();
  const Eigen::MatrixXd A = stacked(others, tolerances);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(A.rows());
  b.head(rows) = own;
  const Eigen::VectorXd best = A.completeOrthogonalDecomposition().solve(b);
  const Eigen::VectorXd left = b - A * best;
  return left.squaredNorm();
}

double imitation(const std::vector<double>& signature, const std::vector<std::vector<double>>& others) {
  const double all = distinct(signature, {}, {});
  return all > 0.0 ? 1.0 - distinct(signature, others, {}) / all : 0.0;
}

}  // namespace wormdrive
