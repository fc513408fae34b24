#pragma once
#include <complex>

#include <Eigen/Core>

namespace wormdrive {

// Compiled once, for these solvers take seconds wherever they are instantiated.

/// A square matrix of few rows.
inline constexpr int most_rows = 16;
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_rows, most_rows>;
/// Eigenvalues of a real matrix.
using Eigenvalues = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, 1, Eigen::ColMajor, most_rows, 1>;
Eigenvalues eigenvalues(const SmallMatrix& matrix);

/// Eigenvalues of a real matrix, and a column of length one for each of them.
struct Eigenpairs {
  Eigenvalues values;
  Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_rows, most_rows> vectors;
};
Eigenpairs eigenpairs(const SmallMatrix& matrix);

}  // namespace wormdrive
