#include "diagnosis/inference/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/fitting/gap_search.hpp"
#include "diagnosis/fitting/stepwise.hpp"
#include "diagnosis/inference/sandwich.hpp"

namespace wormdrive {

Eigen::MatrixXd covariance(const Evaluation& evaluation, const Hypothesis& h, int rounds) {
  if (h.free.empty()) return {};
  const auto n = static_cast<Eigen::Index>(h.free.size());
  const auto spread_over = [&](const std::vector<double>& steps) {
    return sandwich(evaluation, h, central_sensitivities(evaluation, h, steps)).spread;
  };
  Eigen::MatrixXd spread = spread_over(std::vector<double>(h.free.size(), derivative_step));
  for (int round = 0; round < rounds; ++round) spread = spread_over(steps_over_errors(spread.diagonal()));
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
