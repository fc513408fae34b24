#pragma once
#include "diagnosis/fitting/normal_equations.hpp"
#include "diagnosis/fitting/screening.hpp"

namespace wormdrive {

/// A candidate from one start with the columns of its signatures in a linear system; none for a candidate that only
/// sets a stated parameter free.
struct StartColumns {
  std::size_t candidate, start;
  std::vector<Eigen::Index> columns;
};

/// The normal equations A x = b of the data near a hypothesis, weighted by the noise, in scales of the coordinates: its
/// free coordinates first, then all signatures of a screening.
struct LinearSystem {
  Eigen::MatrixXd A{};
  Eigen::VectorXd b{};
  std::vector<StartColumns> starts{};
};

LinearSystem linear_system(const Evaluation& evaluation, const Hypothesis& base, const Screening& screening);

}  // namespace wormdrive
