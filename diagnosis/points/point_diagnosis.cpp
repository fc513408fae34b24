#include "diagnosis/points/point_diagnosis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/QR>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "description/keys.hpp"
#include "diagnosis/points/report.hpp"
#include "diagnosis/report/units_on_axis.hpp"
#include "diagnosis/verdict/extended_scenario.hpp"
#include "statistics/random.hpp"
#include "statistics/student_t.hpp"

namespace wormdrive {
namespace {

constexpr StudentT student;

/// Slopes in units of the noise.
std::vector<std::vector<double>> signatures(const PointFitter& fitter, const PointModel& model, const PointFit& at) {
  std::vector<std::vector<double>> columns = fitter.slopes(model, at.values);
  for (std::vector<double>& column : columns)
    for (std::size_t k = 0; k < column.size(); ++k)
      column[k] *= std::sqrt(student.information()) / (at.scale * fitter.points().deviation[k]);
  return columns;
}

/// Covariance of the values of a fit, by the information of points and tolerances.
Eigen::MatrixXd covariance(const PointFitter& fitter, const FittedModel& model) {
  const std::vector<std::vector<double>> columns = signatures(fitter, model.model, model.all);
  const auto n = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd scales(n);
  for (Eigen::Index a = 0; a < n; ++a) {
    const Coordinate& c = model.model.coordinates[static_cast<std::size_t>(a)];
    const auto& left = columns[static_cast<std::size_t>(a)];
    scales(a) = c.scale;
    for (Eigen::Index b = 0; b < n; ++b) {
      const auto& right = columns[static_cast<std::size_t>(b)];
      information(a, b) = std::inner_product(left.begin(), left.end(), right.begin(), 0.0);
    }
    if (c.tolerance > 0.0) information(a, a) += std::pow(c.scale / c.tolerance, 2);
  }
  return scales.asDiagonal() * information.completeOrthogonalDecomposition().pseudoInverse() * scales.asDiagonal();
}

EstimatedEffect estimated(const PointFitter& fitter, const FittedModel& model, const Eigen::MatrixXd& spread,
                          std::string_view effect) {
  EstimatedEffect made{std::string(effect), {}};
  const std::size_t n = model.model.coordinates.size();
  const double quantile = t_quantile(fitter.points().size() - std::min(fitter.points().size() - 1, n));
  for (std::size_t k = 0; k < n; ++k) {
    const Coordinate& c = model.model.coordinates[k];
    if (c.effect != effect) continue;
    const auto at = static_cast<Eigen::Index>(k);
    const double value = model.all.values[k], error = std::sqrt(std::max(0.0, spread(at, at)));
    made.parameters.push_back({std::string(c.field), field_of({}, c.effect, c.field).unit, value, error,
                               value - quantile * error, value + quantile * error});
  }
  return made;
}

/// Torques at all points, each by the fit of the half that does not hold it.
std::vector<double> held_out_torques(const PointFitter& fitter, const FittedModel& model) {
  std::vector<double> torques = model.all.torques;
  for (const Part part : {Part::first_half, Part::second_half})
    if (const auto fit = fitter.fit(model.model, {model.all.values}, part))
      for (std::size_t k = 0; k < torques.size(); ++k)
        if ((fitter.points().half[k] == 0) != (part == Part::first_half)) torques[k] = fit->torques[k];
  return torques;
}

PredictionError prediction_error(const PredictedTorques& torques, Axis axis, std::uint64_t seed) {
  const auto squares = [&](const std::vector<double>& predicted) {
    std::vector<double> list;
    for (std::size_t k = 0; k < predicted.size(); ++k) list.push_back(std::pow(torques.measured[k] - predicted[k], 2));
    return list;
  };
  const auto rms = [](const std::vector<double>& list) {
    return std::sqrt(std::accumulate(list.begin(), list.end(), 0.0) / static_cast<double>(list.size()));
  };
  PredictionError error;
  error.horizon = error.floor = error.constant_speed = std::numeric_limits<double>::quiet_NaN();
  error.unit = spellings("torque", unit::newton_metre, axis).front().unit;
  error.before = rms(squares(torques.before));
  const std::vector<double> after = squares(torques.after);
  error.after = rms(after);
  std::vector<double> drawn;
  for (std::uint64_t draw = 0; draw < 2000; ++draw) {
    std::vector<double> sample;
    for (std::size_t k = 0; k < after.size(); ++k)
      sample.push_back(after[static_cast<std::size_t>(uniform(seed, Stream::reference, draw * after.size() + k) *
                                                      static_cast<double>(after.size()))]);
    drawn.push_back(rms(sample));
  }
  std::sort(drawn.begin(), drawn.end());
  error.after_low = drawn[drawn.size() / 40];
  error.after_high = drawn[drawn.size() - 1 - drawn.size() / 40];
  return error;
}

}  // namespace

Diagnosis diagnose(const Scenario& scenario, const TorquePoints& points, const std::optional<TorquePoints>& more,
                   const DiagnosisSettings& settings) {
  const auto tell = [&](const std::string& what) {
    if (settings.progress) settings.progress(what);
  };
  const PointFitter fitter(scenario, points);
  const std::vector<PointCandidate> candidates = point_candidates(scenario, points);
  tell("trying effects");
  const PointSelection found = select(fitter, candidates, settings.threads);

  Diagnosis d;
  d.seed = settings.seed;
  tell("estimating");
  const Eigen::MatrixXd spread = covariance(fitter, found.after);
  for (const std::string_view cause : found.after.model.causes)
    d.causes.push_back(estimated(fitter, found.after, spread, cause));
  for (const PointCandidate& candidate : candidates)
    if (candidate.tolerated && !found.after.model.holds(candidate.effect))
      d.calibration.push_back(estimated(fitter, found.after, spread, candidate.effect));
  for (const PointJudgement& judgement : found.judgements)
    d.ranking.push_back(
        {estimated(fitter, judgement.with, covariance(fitter, judgement.with), candidates[judgement.candidate].effect),
         judgement.delta_bic, judgement.held_out_gain, judgement.named, judgement.outcome});
  d.torques = {points.names,
               points.worm_speed,
               points.load_torque,
               points.torque,
               held_out_torques(fitter, found.before),
               held_out_torques(fitter, found.after)};
  d.prediction = {prediction_error(d.torques, scenario.axis, settings.seed)};
  for (std::size_t k = 0; k < points.size(); ++k) {
    d.residual.before.push_back(points.torque[k] - d.torques.before[k]);
    d.residual.after.push_back(points.torque[k] - d.torques.after[k]);
    d.residual.load_torque.push_back(points.load_torque[k]);
    d.residual.gear_speed.push_back(points.worm_speed[k] / stated_ratio(scenario));
    d.residual.held_out.push_back(1);
  }
  tell("working out what the data can show");
  d.certificate = point_certificate(fitter, candidates, found.after);
  d.remainders = point_remainders(points, d.residual.after);
  d.extended = scenario;
  d.noise_torque = found.after.all.scale * *std::max_element(points.deviation.begin(), points.deviation.end());
  put_units_on_axis(d, scenario.axis);
  judge_points(d, found, candidates);
  if (!d.causes.empty())
    d.extended = extended_scenario(scenario, fitter.with(found.after.model, found.after.all.values), {}, d.remarks);
  if (more && !d.classes.empty()) propose_other_load(d, scenario, *more, candidates, found);
  d.passes = fitter.passes();
  return d;
}

}  // namespace wormdrive
