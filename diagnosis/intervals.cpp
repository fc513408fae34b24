#include "diagnosis/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

#include "diagnosis/fit.hpp"
#include "diagnosis/parallel.hpp"
#include "diagnosis/stepwise.hpp"

namespace wormdrive {

Eigen::MatrixXd covariance(const Evaluation& by, const Hypothesis& h) {
  const InnovationLayout& layout = by.layout();
  const auto n = static_cast<Eigen::Index>(h.free.size());
  std::vector<std::vector<double>> J(h.free.size());
  parallel_for(h.free.size(), by.threads(), [&](std::size_t k) {
    J[k] = has_slope(h.free[k]) ? sensitivity(by, h, k, derivative_step) : std::vector<double>(layout.size, 0.0);
  });

  constexpr double nu = tail_freedom;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(layout.blocks), n);
  std::vector<std::uint8_t> counts(layout.blocks, 0);
  Eigen::VectorXd row(n);
  for (std::size_t r = 0; r < layout.size; ++r) {
    if (layout.part[r] != 1) continue;
    const double s = h.noise_model.groups[layout.group[r]].scale, z = h.residuals[r] / s, z2 = z * z;
    for (Eigen::Index k = 0; k < n; ++k) row[k] = J[static_cast<std::size_t>(k)][r] / s;
    slopes.row(static_cast<Eigen::Index>(layout.block[r])) += ((nu + 1.0) * z / (nu + z2)) * row.transpose();
    H += ((nu + 1.0) * (nu - z2) / ((nu + z2) * (nu + z2))) * (row * row.transpose());
    counts[layout.block[r]] = 1;
  }
  const auto used = static_cast<double>(std::count(counts.begin(), counts.end(), std::uint8_t{1}));
  const Eigen::RowVectorXd mean = slopes.colwise().sum() / std::max(1.0, used);
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t b = 0; b < layout.blocks; ++b) {
    if (!counts[b]) continue;
    const Eigen::RowVectorXd off = slopes.row(static_cast<Eigen::Index>(b)) - mean;
    B += off.transpose() * off;
  }
  B *= used / std::max(1.0, used - static_cast<double>(n));
  Eigen::MatrixXd tolerances = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(n);
  add_tolerances(h, tolerances, pull);
  H += tolerances;
  B += tolerances;
  H.diagonal() += 1e-9 * H.diagonal() + Eigen::VectorXd::Constant(n, 1e-12);
  const Eigen::MatrixXd inverse = H.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
  Eigen::VectorXd scales(n);
  for (Eigen::Index k = 0; k < n; ++k) scales[k] = h.free[static_cast<std::size_t>(k)].scale;
  Eigen::MatrixXd spread = scales.asDiagonal() * (inverse * B * inverse) * scales.asDiagonal();
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto q = static_cast<std::size_t>(k);
    constexpr double flat = 1e-6;
    if (!has_slope(h.free[q]))
      spread(k, k) = std::pow(spread_of_steps(by, h, q), 2);
    else if (H(k, k) < flat)  // these data tell no size
      spread(k, k) = std::pow(h.free[q].high - h.free[q].low, 2);
  }
  return spread;
}

namespace {

/// What the predictor itself gets wrong, beyond the noise, for one by teeth that yield a little: standard error of a
/// coordinate in SI.
double structural_error(const Coordinate& c, double value) {
  constexpr double rigid_share = 0.01;   // of a size that shows: less than a thousandth of all that acts
  constexpr double moving_share = 0.03;  // of an inertia, which seems the smaller the faster the motion
  constexpr double held_torque = 2e-5;   // [s], of a lag or delay that acts on a torque held over a sample
  constexpr double impact_share = 0.03;  // of a gap, by how an impact goes on
  constexpr double yielding = 2e-5;      // [rad], of a gap, by which loaded teeth make it seem wider
  constexpr double limit_share = 1e-3;   // of a limit that is met in the fastest motions
  constexpr double shape_share = 0.1;    // of a fall over the speed, by laws of other shapes
  if (c.effect == "backlash") return std::hypot(impact_share * value, yielding);
  if (c.effect == "stribeck") return shape_share * value;
  if (c.effect == "torque_saturation") return limit_share * value;
  if (c.effect == "worm_inertia" || c.effect == "gear_inertia") return moving_share * c.scale;
  return c.effect == "actuator_lag" || c.effect == "actuator_delay" ? held_torque : rigid_share * c.scale;
}

}  // namespace

EstimatedEffect estimated(const Hypothesis& h, const Eigen::MatrixXd& covariance, std::string_view effect,
                          const std::vector<Coordinate>& coordinates) {
  EstimatedEffect e{std::string(effect), {}};
  const Effects<double> now = extended(h);
  const auto n = static_cast<Eigen::Index>(h.free.size());
  const auto add = [&](std::string_view field) {
    const FieldOfEffect at = field_of(now, effect, field);
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(n), structural = Eigen::VectorXd::Zero(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto q = static_cast<std::size_t>(k);
      if (h.free[q].effect != effect) continue;
      constexpr double step = 1e-5;
      Hypothesis moved{.effects = h.effects, .free = h.free, .values = h.values};
      moved.values[q] += step * h.free[q].scale;
      const double change = field_of(extended(moved), effect, field).value - at.value;
      slope[k] =
          (field == "phase" ? std::remainder(change, 2.0 * std::numbers::pi) : change) / (step * h.free[q].scale);
      structural[k] = slope[k] * structural_error(h.free[q], h.values[q]);
    }
    const double error = std::sqrt(std::max(0.0, slope.dot(covariance * slope)) + structural.squaredNorm());
    constexpr double normal_95 = 1.96;
    e.parameters.push_back(
        {std::string(field), at.unit, at.value, error, at.value - normal_95 * error, at.value + normal_95 * error});
  };
  for (const Coordinate& c : coordinates)
    for (const std::string_view field : fields_of(c)) add(field);
  if (effect == "cogging")
    e.parameters.push_back([&] {
      const FieldOfEffect periods = field_of(now, effect, "periods");
      return Estimate{"periods", periods.unit, periods.value, 0.0, periods.value, periods.value};
    }());
  return e;
}

}  // namespace wormdrive
