#include "diagnosis/inference/sandwich.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/fitting/stepwise.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "statistics/parallel.hpp"
#include "statistics/symmetric_eigen.hpp"

namespace wormdrive {

namespace {

/// Curvature and slope of the log likelihood of one block of time, in scales of the free coordinates.
struct BlockSlopes {
  Eigen::MatrixXd curvature;
  Eigen::VectorXd slope;
};

/// Of the blocks that are fitted.
std::vector<BlockSlopes> slopes_by_block(const Evaluation& evaluation, const Hypothesis& h, const Slopes& J) {
  const InnovationLayout& layout = evaluation.layout();
  const auto n = static_cast<Eigen::Index>(h.free.size());
  std::vector<BlockSlopes> all(layout.blocks, {Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)});
  std::vector<std::uint8_t> used(layout.blocks, 0);
  Eigen::VectorXd row(n);
  for (std::size_t r = 0; r < layout.size; ++r) {
    if (layout.part[r] != 1) continue;
    const NoiseGroup& group = h.noise_model.groups[layout.group[r]];
    const double nu = group.freedom, s = group.scale, z = h.residuals[r] / s, z2 = z * z;
    row = J.row(static_cast<Eigen::Index>(r)).transpose().cast<double>() / s;
    BlockSlopes& block = all[layout.block[r]];
    block.slope += ((nu + 1.0) * z / (nu + z2)) * row;
    block.curvature += ((nu + 1.0) * (nu - z2) / ((nu + z2) * (nu + z2))) * (row * row.transpose());
    used[layout.block[r]] = 1;
  }
  std::size_t kept = 0;
  for (std::size_t b = 0; b < all.size(); ++b)
    if (used[b]) std::swap(all[kept++], all[b]);
  all.resize(kept);
  return all;
}

}  // namespace

Slopes central_sensitivities(const Evaluation& evaluation, const Hypothesis& h, const std::vector<double>& steps) {
  Slopes J = Slopes::Zero(static_cast<Eigen::Index>(evaluation.layout().size), static_cast<Eigen::Index>(steps.size()));
  parallel_for(h.free.size(), evaluation.threads(), [&](std::size_t k) {
    if (!has_slope(h.free[k])) return;
    for (const double step : {steps[k], -steps[k]}) {
      const std::vector<double> side = sensitivity(evaluation, h, k, step);
      J.col(static_cast<Eigen::Index>(k)) +=
          0.5F * Eigen::Map<const Eigen::VectorXd>(side.data(), J.rows()).cast<float>();
    }
  });
  return J;
}

std::vector<double> steps_over_errors(const Eigen::VectorXd& variances) {
  constexpr double longest = 1.0;
  std::vector<double> steps;
  for (const double variance : variances) steps.push_back(std::clamp(std::sqrt(variance), derivative_step, longest));
  return steps;
}

Sandwich sandwich(const Evaluation& evaluation, const Hypothesis& h, const Slopes& J) {
  const std::vector<BlockSlopes> blocks = slopes_by_block(evaluation, h, J);
  const auto n = static_cast<Eigen::Index>(h.free.size());
  Eigen::MatrixXd tolerances = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(n), pull = Eigen::VectorXd::Zero(n);
  add_tolerances(h, tolerances, pull);
  Eigen::MatrixXd H = tolerances;
  for (const BlockSlopes& b : blocks) {
    H += b.curvature;
    mean += b.slope / static_cast<double>(blocks.size());
  }
  // in coordinates in which the curvature is that of independent unit errors
  const SymmetricEigen of_curvature = symmetric_eigen(H);
  constexpr double flat = 1e-12;
  const Eigen::MatrixXd W =
      of_curvature.vectors * of_curvature.values.cwiseMax(flat).cwiseSqrt().cwiseInverse().asDiagonal();
  Eigen::MatrixXd scatter = W.transpose() * tolerances * W;
  Eigen::MatrixXd by_weights = scatter;
  for (const BlockSlopes& b : blocks) {
    const Eigen::VectorXd slope = W.transpose() * (b.slope - mean);
    by_weights += slope * slope.transpose();
    // what a block says is judged without what it has itself done to the fit
    const SymmetricEigen own = symmetric_eigen(W.transpose() * b.curvature * W);
    const Eigen::ArrayXd left = 1.0 - own.values.array().max(0.0).min(rules::most_own_curvature);
    const Eigen::VectorXd y = own.vectors.transpose() * slope;
    const Eigen::VectorXd alone = own.vectors * (y.array() / left).matrix();
    scatter += alone * alone.transpose();
  }
  // few blocks may scatter less than the likelihood allows
  const SymmetricEigen of_scatter = symmetric_eigen(scatter);
  const Eigen::MatrixXd U = W * of_scatter.vectors;
  const Eigen::VectorXd least_scatter = of_scatter.values.cwiseMax(1.0);
  const Eigen::MatrixXd spread = U * least_scatter.asDiagonal() * U.transpose();
  return {spread, spread - W * by_weights * W.transpose()};
}

}  // namespace wormdrive
