#include "diagnosis/inference/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/fitting/gap_search.hpp"
#include "diagnosis/fitting/stepwise.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "diagnosis/rules/noise.hpp"
#include "statistics/parallel.hpp"
#include "statistics/symmetric_eigen.hpp"

namespace wormdrive {

namespace {

/// Curvature and slope of the log likelihood of one block of time, in scales of the free coordinates.
struct BlockSlopes {
  Eigen::MatrixXd curvature;
  Eigen::VectorXd slope;
};

/// Of the blocks that are fitted. steps: of the free coordinates for their derivatives, in scales.
std::vector<BlockSlopes> slopes_by_block(const Evaluation& evaluation, const Hypothesis& h,
                                         const std::vector<double>& steps) {
  const InnovationLayout& layout = evaluation.layout();
  const auto n = static_cast<Eigen::Index>(h.free.size());
  std::vector<std::vector<double>> J(h.free.size());
  parallel_for(h.free.size(), evaluation.threads(), [&](std::size_t k) {
    J[k].assign(layout.size, 0.0);
    if (!has_slope(h.free[k])) return;
    for (const double step : {steps[k], -steps[k]}) {
      const std::vector<double> side = sensitivity(evaluation, h, k, step);
      for (std::size_t r = 0; r < layout.size; ++r) J[k][r] += 0.5 * side[r];
    }
  });
  constexpr double nu = rules::tail_freedom;
  std::vector<BlockSlopes> all(layout.blocks, {Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)});
  std::vector<std::uint8_t> used(layout.blocks, 0);
  Eigen::VectorXd row(n);
  for (std::size_t r = 0; r < layout.size; ++r) {
    if (layout.part[r] != 1) continue;
    const double s = h.noise_model.groups[layout.group[r]].scale, z = h.residuals[r] / s, z2 = z * z;
    for (Eigen::Index k = 0; k < n; ++k) row[k] = J[static_cast<std::size_t>(k)][r] / s;
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

/// Covariance in scales.
Eigen::MatrixXd sandwich(const Evaluation& evaluation, const Hypothesis& h, const std::vector<double>& steps) {
  const std::vector<BlockSlopes> blocks = slopes_by_block(evaluation, h, steps);
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
  for (const BlockSlopes& b : blocks) {
    // what a block says is judged without what it has itself done to the fit
    const SymmetricEigen own = symmetric_eigen(W.transpose() * b.curvature * W);
    const Eigen::ArrayXd left = 1.0 - own.values.array().max(0.0).min(rules::most_own_curvature);
    const Eigen::VectorXd y = own.vectors.transpose() * (W.transpose() * (b.slope - mean));
    const Eigen::VectorXd alone = own.vectors * (y.array() / left).matrix();
    scatter += alone * alone.transpose();
  }
  // few blocks may scatter less than the likelihood allows
  const SymmetricEigen of_scatter = symmetric_eigen(scatter);
  const Eigen::MatrixXd U = W * of_scatter.vectors;
  return U * of_scatter.values.cwiseMax(1.0).asDiagonal() * U.transpose();
}

}  // namespace

Eigen::MatrixXd covariance(const Evaluation& evaluation, const Hypothesis& h, int rounds) {
  if (h.free.empty()) return {};
  const auto n = static_cast<Eigen::Index>(h.free.size());
  std::vector<double> steps(h.free.size(), derivative_step);
  Eigen::MatrixXd spread = sandwich(evaluation, h, steps);
  for (int round = 0; round < rounds; ++round) {
    constexpr double longest = 1.0;
    for (Eigen::Index k = 0; k < n; ++k)
      steps[static_cast<std::size_t>(k)] = std::clamp(std::sqrt(spread(k, k)), derivative_step, longest);
    spread = sandwich(evaluation, h, steps);
  }
  Eigen::VectorXd scales(n);
  for (Eigen::Index k = 0; k < n; ++k) scales[k] = h.free[static_cast<std::size_t>(k)].scale;
  spread = scales.asDiagonal() * spread * scales.asDiagonal();
  for (Eigen::Index k = 0; k < n; ++k) {
    const Coordinate& c = h.free[static_cast<std::size_t>(k)];
    if (!has_slope(c)) {
      spread.row(k).setZero();
      spread.col(k).setZero();
      spread(k, k) = std::pow(spread_of_steps(evaluation, h, static_cast<std::size_t>(k)), 2);
    }
    spread(k, k) = std::min(spread(k, k), std::pow(c.high - c.low, 2));  // these data tell no size
  }
  return spread;
}

namespace {

/// What the predictor itself gets wrong, beyond the noise, for one by teeth that yield a little: standard error of a
/// free coordinate in SI.
double structural_error(const Hypothesis& h, std::size_t k) {
  const Coordinate& c = h.free[k];
  // teeth that meet across a gap make the likelihood rough, and what is stated look known better than it is
  if (c.tolerance > 0.0 && gap_of(h)) return c.tolerance;
  ModelError error = c.model_error;
  double value = h.values[k];
  if (!c.blurred_by.empty())  // a level at rest, from where a law falls
    if (const int q = index_of(h, c.blurred_by, c.blurred_by_field); q >= 0) {
      value = h.values[static_cast<std::size_t>(q)];
      error = h.free[static_cast<std::size_t>(q)].model_error;
    }
  return std::hypot(std::hypot(error.of_value * value, error.of_scale * c.scale), error.size);
}

}  // namespace

namespace {

/// How a field of an effect moves with the free coordinates.
Eigen::VectorXd field_slope(const Hypothesis& h, std::string_view effect, std::string_view field) {
  const double value = field_of(extended(h), effect, field).value;
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(h.free.size()));
  for (std::size_t k = 0; k < h.free.size(); ++k) {
    if (h.free[k].effect != effect) continue;
    constexpr double step = 1e-5;
    Hypothesis moved{.drive = h.drive, .free = h.free, .values = h.values};
    moved.values[k] += step * h.free[k].scale;
    const double change = field_of(extended(moved), effect, field).value - value;
    slope[static_cast<Eigen::Index>(k)] =
        (field == "phase" ? std::remainder(change, 2.0 * std::numbers::pi) : change) / (step * h.free[k].scale);
  }
  return slope;
}

/// A covariance of the free coordinates with what the predictor itself gets wrong.
Eigen::MatrixXd with_structural_errors(const Hypothesis& h, Eigen::MatrixXd covariance) {
  for (std::size_t k = 0; k < h.free.size(); ++k) {
    const auto q = static_cast<Eigen::Index>(k);
    covariance(q, q) += std::pow(structural_error(h, k), 2);
  }
  return covariance;
}

Estimate estimate(std::string_view field, const FieldOfEffect& at, double variance) {
  return estimate(field, at.unit, at.value, std::sqrt(std::max(0.0, variance)));
}

}  // namespace

Estimate estimate(std::string_view field, const Unit& unit, double value, double error) {
  constexpr double normal_95 = 1.96;
  return {std::string(field), unit, value, error, value - normal_95 * error, value + normal_95 * error};
}

EstimatedEffect estimated(const Hypothesis& h, const Eigen::MatrixXd& covariance, std::string_view effect,
                          const std::vector<Coordinate>& coordinates) {
  EstimatedEffect e{std::string(effect), {}};
  const RecordedDrive now = extended(h);
  const Eigen::MatrixXd spread = with_structural_errors(h, covariance);
  for (const Coordinate& c : coordinates)
    for (const std::string_view field : fields_of(c)) {
      const Eigen::VectorXd slope = field_slope(h, effect, field);
      e.parameters.push_back(estimate(field, field_of(now, effect, field), slope.dot(spread * slope)));
    }
  if (const std::string_view tried = coordinates.front().tried; !tried.empty())
    e.parameters.push_back(estimate(tried, field_of(now, effect, tried), 0.0));
  now.faults.for_each([&]<class Fault>(const std::optional<Fault>& fault) {
    if (fault && Fault::id == effect) e.remedy = fault->remedy();
  });
  return e;
}

JointEstimate joint_estimate(const Hypothesis& h, const Eigen::MatrixXd& covariance) {
  JointEstimate joint;
  const RecordedDrive now = extended(h);
  std::vector<Eigen::VectorXd> slopes;
  const Eigen::MatrixXd spread = with_structural_errors(h, covariance);
  for (const Coordinate& c : h.free)
    for (const std::string_view field : fields_of(c)) {
      const Eigen::VectorXd slope = field_slope(h, c.effect, field);
      const double variance = slope.dot(spread * slope);
      if (!(variance > 0.0)) continue;
      joint.effects.emplace_back(c.effect);
      joint.numbers.push_back(estimate(field, field_of(now, c.effect, field), variance));
      slopes.push_back(slope);
    }
  for (std::size_t a = 0; a < slopes.size(); ++a) {
    joint.correlation.emplace_back();
    for (std::size_t b = 0; b < slopes.size(); ++b)
      joint.correlation.back().push_back(a == b
                                             ? 1.0
                                             : slopes[a].dot(spread * slopes[b]) /
                                                   (joint.numbers[a].standard_error * joint.numbers[b].standard_error));
  }
  return joint;
}

}  // namespace wormdrive
