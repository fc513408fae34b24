#pragma once
#include <complex>

#include <Eigen/Core>

namespace wormdrive {

// Compiled once, for these solvers take seconds wherever they are instantiated.

/// A square matrix of at most four rows.
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 4, 4>;
/// Eigenvalues of a real matrix.
Eigen::Matrix<std::complex<double>, Eigen::Dynamic, 1, Eigen::ColMajor, 4, 1> eigenvalues(const SmallMatrix& matrix);

/// Eigenvalues of a real matrix, and a column of length one for each of them.
struct Eigenpairs {
  Eigen::Matrix<std::complex<double>, 6, 1> values;
  Eigen::Matrix<std::complex<double>, 6, 6> vectors;
};
Eigenpairs eigenpairs(const Eigen::Matrix<double, 6, 6>& matrix);

}  // namespace wormdrive
