#include "diagnosis/fitting/linear_system.hpp"

#include <algorithm>

namespace wormdrive {

LinearSystem linear_system(const Evaluation& evaluation, const Hypothesis& base, const Screening& screening) {
  LinearSystem made;
  const WeightedColumns weigh(fit_weights(evaluation.layout(), base.residuals, base.noise_model));
  const auto free = static_cast<Eigen::Index>(screening.free_columns.size());
  std::vector<const std::vector<float>*> signatures;
  for (const Screened& s : screening.found) {
    if (s.is_far) continue;
    made.starts.push_back({s.candidate, s.start, {}});
    for (const auto& signature : s.signatures) {
      made.starts.back().columns.push_back(free + static_cast<Eigen::Index>(signatures.size()));
      signatures.push_back(&signature);
    }
  }
  const auto n = free + static_cast<Eigen::Index>(signatures.size());
  made.A = Eigen::MatrixXd::Zero(n, n);
  made.b = Eigen::VectorXd::Zero(n);
  for (Eigen::Index begin = 0; begin < weigh.rows(); begin += rows_of_part) {
    const Eigen::Index rows = std::min(rows_of_part, weigh.rows() - begin);
    Eigen::MatrixXd V(rows, n);
    Eigen::Index column = 0;
    for (const auto& c : screening.free_columns) V.col(column++) = weigh(c, begin, rows);
    for (const auto* const s : signatures) V.col(column++) = weigh(*s, begin, rows);
    made.A.noalias() += V.transpose() * V;
    made.b.noalias() -= V.transpose() * weigh(base.residuals, begin, rows);
  }
  return made;
}

}  // namespace wormdrive
