#include "core/numbers/eigenvalues.hpp"

#include <Eigen/Eigenvalues>

namespace wormdrive {

Eigenvalues eigenvalues(const SmallMatrix& matrix) {
  return Eigen::EigenSolver<SmallMatrix>(matrix, false).eigenvalues();
}

Eigenpairs eigenpairs(const SmallMatrix& matrix) {
  const Eigen::EigenSolver<SmallMatrix> solved(matrix);
  return {solved.eigenvalues(), solved.eigenvectors()};
}

}  // namespace wormdrive
