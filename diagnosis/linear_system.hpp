#pragma once
#include "diagnosis/normal_equations.hpp"
#include "diagnosis/screening.hpp"

namespace wormdrive {

/// A suspect from one start with the columns of its signatures in a linear system; none for a suspect that only sets a
/// stated number free.
struct StartColumns {
  std::size_t suspect, start;
  std::vector<Eigen::Index> columns;
};

/// The normal equations A x = b of the data near a hypothesis, weighted by the noise, in scales of the coordinates: its
/// free coordinates first, then all signatures of a screening.
struct LinearSystem {
  Eigen::MatrixXd A{};
  Eigen::VectorXd b{};
  std::vector<StartColumns> starts{};
};

LinearSystem linear_system(const Evaluation& by, const Hypothesis& base, const Screening& screening);

}  // namespace wormdrive
