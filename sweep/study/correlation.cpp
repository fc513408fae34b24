#include "sweep/study/correlation.hpp"

#include <limits>

#include "statistics/symmetric_eigen.hpp"

namespace wormdrive {

bool Copula::exists(const Eigen::MatrixXd& matrix) {
  const Eigen::VectorXd eigenvalues = symmetric_eigenvalues(matrix);
  // beyond this bound every order has a factor [Wilkinson1968]
  const auto n = static_cast<double>(matrix.rows());
  return eigenvalues.minCoeff() >
         20.0 * n * std::sqrt(n) * std::numeric_limits<double>::epsilon() * eigenvalues.maxCoeff();
}

}  // namespace wormdrive
