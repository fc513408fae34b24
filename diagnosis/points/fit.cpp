#include "diagnosis/points/fit.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <ceres/ceres.h>

#include "statistics/student_t.hpp"

namespace wormdrive {
namespace {

constexpr StudentT torque_law;
/// A share of the points' deviations: data without noise have a likelihood too.
constexpr double least_torque_scale = 1e-6;

bool fitted(Part part, int half) {
  switch (part) {
    case Part::all: return true;
    case Part::first_half: return half == 0;
    case Part::second_half: return half == 1;
  }
  return true;
}

/// Residuals whose half squares are the negative log likelihood at a given scale.
struct Residuals {
  const TorquePoints& points;
  const PointModel& model;
  const std::vector<std::size_t>& rows;
  const double& scale;
  MovedEffects& effects;

  bool operator()(double const* const* x, double* r) const {
    std::vector<double> values(model.coordinates.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
      const Coordinate& c = model.coordinates[k];
      values[k] = std::clamp(x[0][k] * c.scale, c.low, c.high);  // differences may step over a bound
      *r++ = c.tolerance > 0.0 ? (values[k] - c.centre) / c.tolerance : 0.0;
    }
    const std::vector<double> torques = points.predict(effects(values));
    if (torques.empty()) return false;
    for (const std::size_t k : rows)
      *r++ = torque_law.as_normal((points.torque[k] - torques[k]) / points.deviation[k], scale);
    return true;
  }
};

}  // namespace

bool PointModel::holds(std::string_view effect) const {
  return std::find(causes.begin(), causes.end(), effect) != causes.end();
}

std::vector<int> every_second(const std::vector<int>& direction, const std::vector<double>& size) {
  std::vector<std::size_t> order(size.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return direction[a] != direction[b] ? direction[a] < direction[b] : std::abs(size[a]) < std::abs(size[b]);
  });
  std::vector<int> half(size.size());
  for (std::size_t k = 0; k < order.size(); ++k) half[order[k]] = static_cast<int>(k % 2);
  return half;
}

Effects<double> PointFitter::with(const PointModel& model, const std::vector<double>& values) const {
  Effects<double> effects = scenario_.effects;
  apply(effects, model.coordinates, values);
  return effects;
}

std::vector<double> PointFitter::errors(const std::vector<double>& torques) const {
  std::vector<double> errors(points_.size());
  for (std::size_t k = 0; k < errors.size(); ++k) errors[k] = points_.torque[k] - torques[k];
  return errors;
}

double PointFitter::held_out(const PointFit& fit, Part part) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (!fitted(part, points_.half[k]))
      sum += torque_law.nll((points_.torque[k] - fit.torques[k]) / points_.deviation[k], fit.scale);
  return sum;
}

std::vector<std::vector<double>> PointFitter::slopes(const PointModel& model, const std::vector<double>& values) const {
  std::vector<std::vector<double>> columns;
  for (std::size_t k = 0; k < model.coordinates.size(); ++k) {
    const Coordinate& c = model.coordinates[k];
    const double step = 1e-5 * c.scale;
    std::vector<double> up = values, down = values;
    up[k] = std::min(c.high, values[k] + step);
    down[k] = std::max(c.low, values[k] - step);
    std::vector<double> column = points_.predict(with(model, up));
    const std::vector<double> lower = points_.predict(with(model, down));
    passes_ += 2;
    if (column.empty() || lower.empty() || up[k] == down[k]) {
      column.assign(points_.size(), 0.0);
    } else {
      for (std::size_t row = 0; row < column.size(); ++row)
        column[row] = (column[row] - lower[row]) / (up[k] - down[k]) * c.scale;
    }
    columns.push_back(std::move(column));
  }
  return columns;
}

std::optional<PointFit> PointFitter::fit_once(const PointModel& model, std::vector<double> values, Part part,
                                              const Effort& effort) const {
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (fitted(part, points_.half[k])) rows.push_back(k);
  const std::size_t n = model.coordinates.size();
  std::vector<double> x(std::max<std::size_t>(1, n));
  for (std::size_t k = 0; k < n; ++k) x[k] = values[k] / model.coordinates[k].scale;

  PointFit fit;
  MovedEffects effects(scenario_.effects, model.coordinates);
  const auto evaluate = [&] {
    for (std::size_t k = 0; k < n; ++k)
      values[k] = std::clamp(x[k] * model.coordinates[k].scale, model.coordinates[k].low, model.coordinates[k].high);
    fit.torques = points_.predict(effects(values));
    ++passes_;
    if (fit.torques.empty()) return false;
    std::vector<double> errors;
    for (const std::size_t k : rows) errors.push_back((points_.torque[k] - fit.torques[k]) / points_.deviation[k]);
    if (fit.scale == 0.0) {  // a start that outliers do not spoil
      std::vector<double> sizes;
      for (const double e : errors) sizes.push_back(std::abs(e));
      std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2), sizes.end());
      fit.scale = std::max(least_torque_scale, 1.4826 * sizes[sizes.size() / 2]);
    }
    fit.scale = torque_law.scale(errors, fit.scale, least_torque_scale);
    fit.nll = 0.0;
    for (const double e : errors) fit.nll += torque_law.nll(e, fit.scale);
    for (std::size_t k = 0; k < n; ++k) {
      const Coordinate& c = model.coordinates[k];
      if (c.tolerance > 0.0) fit.nll += 0.5 * std::pow((values[k] - c.centre) / c.tolerance, 2);
    }
    return true;
  };
  if (!evaluate()) return std::nullopt;

  if (n > 0) {
    const auto cost_by = [&]<ceres::NumericDiffMethodType way>() -> ceres::DynamicCostFunction* {
      return new ceres::DynamicNumericDiffCostFunction<Residuals, way>(
          new Residuals{points_, model, rows, fit.scale, effects});
    };
    ceres::DynamicCostFunction* const cost =
        effort.central ? cost_by.operator()<ceres::CENTRAL>() : cost_by.operator()<ceres::FORWARD>();
    cost->AddParameterBlock(static_cast<int>(n));
    cost->SetNumResiduals(static_cast<int>(n + rows.size()));
    ceres::Problem problem;
    problem.AddResidualBlock(cost, nullptr, x.data());
    for (std::size_t k = 0; k < n; ++k) {
      const Coordinate& c = model.coordinates[k];
      if (std::isfinite(c.low)) problem.SetParameterLowerBound(x.data(), static_cast<int>(k), c.low / c.scale);
      if (std::isfinite(c.high)) problem.SetParameterUpperBound(x.data(), static_cast<int>(k), c.high / c.scale);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 60;
    options.function_tolerance = effort.tolerance;
    options.logging_type = ceres::SILENT;
    for (int round = 0; round < effort.rounds; ++round) {  // between the parameters and the scale, until neither gains
      const double before = fit.nll;
      ceres::Solver::Summary summary;
      ceres::Solve(options, &problem, &summary);
      passes_ += summary.num_residual_evaluations +
                 (effort.central ? 2 : 1) * static_cast<long>(n) * summary.num_jacobian_evaluations;
      if (!evaluate()) return std::nullopt;
      if (before - fit.nll < effort.gain) break;
    }
  }
  fit.values = values;
  return fit;
}

std::optional<PointFit> PointFitter::fit(const PointModel& model, const std::vector<std::vector<double>>& starts,
                                         Part part, const Effort& effort) const {
  std::optional<PointFit> best;
  for (const std::vector<double>& start : starts) {
    std::optional<PointFit> found = fit_once(model, start, part, effort);
    if (found && (!best || found->nll < best->nll)) best = std::move(found);
  }
  return best;
}

}  // namespace wormdrive
