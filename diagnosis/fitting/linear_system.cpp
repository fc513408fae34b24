#include "diagnosis/fitting/linear_system.hpp"

namespace wormdrive {

LinearSystem linear_system(const Evaluation& evaluation, const Hypothesis& base, const Screening& screening) {
  LinearSystem made;
  const WeightedColumns weigh(fit_weights(evaluation.layout(), base.residuals, base.noise_model));
  const Eigen::VectorXd residual = weigh(base.residuals);
  std::vector<Eigen::VectorXd> columns;
  for (const auto& c : screening.free_columns) columns.push_back(weigh(c));
  for (const Screened& s : screening.found) {
    if (s.is_far) continue;
    made.starts.push_back({s.candidate, s.start, {}});
    for (const auto& c : s.signatures) {
      made.starts.back().columns.push_back(static_cast<Eigen::Index>(columns.size()));
      columns.push_back(weigh(c));
    }
  }
  Eigen::MatrixXd V(residual.size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) V.col(static_cast<Eigen::Index>(k)) = columns[k];
  made.A = V.transpose() * V;
  made.b = -V.transpose() * residual;
  return made;
}

}  // namespace wormdrive
