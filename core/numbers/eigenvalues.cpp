#include "core/numbers/eigenvalues.hpp"

#include <Eigen/Eigenvalues>

namespace wormdrive {

Eigenvalues eigenvalues(const SmallMatrix& matrix) {
  return Eigen::EigenSolver<SmallMatrix>(matrix, false).eigenvalues();
}

Eigenpairs eigenpairs(const Eigen::Matrix<double, 6, 6>& matrix) {
  const Eigen::EigenSolver<Eigen::Matrix<double, 6, 6>> solved(matrix);
  return {solved.eigenvalues(), solved.eigenvectors()};
}

}  // namespace wormdrive
