#pragma once
#include <Eigen/Core>

namespace wormdrive {

/// Eigenvalues of a symmetric matrix, the smallest first, and a column of length one for each of them.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);

/// The same without the vectors.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

}  // namespace wormdrive
