#include "diagnosis/verdict/torque_map.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "description/build.hpp"
#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/fitting/prediction_error.hpp"
#include "diagnosis/rules/verdict.hpp"
#include "statistics/parallel.hpp"

namespace wormdrive {

namespace {

/// The map among the effects of a drive.
template <class Drive>
auto& map_of(Drive& drive) {
  return std::get<std::optional<TorqueMap<double>>>(drive.effects.list);
}

/// What a map could be over, at every sample at which the drive moves.
std::vector<double> values_of_axis(const Evaluation& evaluation, const Hypothesis& h, MapAxis over) {
  std::vector<double> all;
  std::vector<FilteredStates> states;
  if (!evaluation.innovations(extended(h), h.noise, {}, &states)) return all;
  const double ratio = stated_mesh(evaluation.scenario()).i;
  for (std::size_t r = 0; r < states.size(); ++r) {
    const PreparedRecording& recording = evaluation.layout().recordings[r];
    for (std::size_t k = 0; k < recording.samples(); ++k)
      if (recording.moving[k])
        all.push_back(over == MapAxis::worm_speed ? ratio * states[r].speed[k] : states[r].angle[k]);
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Points with equally many samples between them, from the first to the last; fewer where these lie in one place.
std::vector<double> points_among(const std::vector<double>& sorted, std::size_t count) {
  std::vector<double> points;
  const double least = 1e-3 * (sorted.back() - sorted.front());  // closer ones would be one point by any smoothness
  for (std::size_t k = 0; k < count; ++k) {
    const double x = sorted[k * (sorted.size() - 1) / (count - 1)];
    if (points.empty() || x > points.back() + least) points.push_back(x);
  }
  return points;
}

/// The normal equations of the values of a map, for all data and for each of several parts of them.
struct MapEquations {
  static constexpr std::size_t parts = 4;
  Eigen::MatrixXd A, roughness;
  Eigen::VectorXd b, values;
  std::array<Eigen::MatrixXd, parts> A_of;
  std::array<Eigen::VectorXd, parts> b_of;

  /// A smoothness makes the roughness of the values cost as much as so many times what the data know of them.
  Eigen::VectorXd step(const Eigen::MatrixXd& data, const Eigen::VectorXd& slope, double smoothness) const {
    const Eigen::MatrixXd rough = smoothness * A.trace() / roughness.trace() * roughness;
    return solve_normal(data + rough, slope - rough * values);
  }
  /// How much worse the parts are predicted by what was fitted to the others [nats], against no step at all.
  double left_out(double smoothness) const {
    double sum = 0.0;
    for (std::size_t p = 0; p < parts; ++p) {
      const Eigen::VectorXd x = step(A - A_of[p], b - b_of[p], smoothness);
      sum += 0.5 * x.dot(A_of[p] * x) - x.dot(b_of[p]);
    }
    return sum;
  }
};

/// Of a hypothesis whose map is on; torque: a change on the worm that shows [N m].
MapEquations map_equations(const Evaluation& evaluation, const Hypothesis& h, double torque) {
  const TorqueMap<double>& map = *map_of(h.drive);
  const std::vector<double>& points = map.table.points();
  const auto n = static_cast<Eigen::Index>(points.size());
  if (map.shaft == MapShaft::gear) torque *= stated_mesh(evaluation.scenario()).i;
  const std::vector<double> weights = fit_weights(evaluation.layout(), h.residuals, h.noise_model);
  const WeightedColumns weigh(weights);
  const Eigen::VectorXd residual = weigh(h.residuals);
  Eigen::MatrixXd V = Eigen::MatrixXd::Zero(residual.size(), n);
  parallel_for(points.size(), evaluation.threads(), [&](std::size_t k) {
    RecordedDrive moved = extended(h);
    std::vector<double> values = map.table.values();
    values[k] += torque;
    map_of(moved)->table = CubicTable(points, std::move(values));
    if (const auto e = evaluation.innovations(moved, h.noise))
      V.col(static_cast<Eigen::Index>(k)) = weigh(difference(evaluation, h, *e)) / torque;
  });

  MapEquations q;
  q.values = Eigen::Map<const Eigen::VectorXd>(map.table.values().data(), n);
  q.roughness = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 1; k + 1 < n; ++k) {  // the square of the second derivative, summed up over the axis
    const auto at = static_cast<std::size_t>(k);
    const double before = points[at] - points[at - 1], after = points[at + 1] - points[at];
    Eigen::VectorXd bend = Eigen::VectorXd::Zero(n);
    bend.segment(k - 1, 3) = Eigen::Vector3d(1.0 / before, -1.0 / before - 1.0 / after, 1.0 / after);
    q.roughness += 2.0 / (before + after) * bend * bend.transpose();
  }
  // block after block, each to the next part
  q.A = q.roughness * 0.0;
  q.b = q.values * 0.0;
  q.A_of.fill(q.A);
  q.b_of.fill(q.b);
  std::vector<std::uint32_t> blocks;
  for (std::size_t k = 0; k < weights.size(); ++k)
    if (weights[k] > 0.0) blocks.push_back(evaluation.layout().block[k]);
  for (std::size_t begin = 0, end = 0, count = 0; begin < blocks.size(); begin = end, ++count) {
    while (end < blocks.size() && blocks[end] == blocks[begin]) ++end;
    const auto first = static_cast<Eigen::Index>(begin), rows = static_cast<Eigen::Index>(end - begin);
    const auto block = V.middleRows(first, rows);
    q.A_of[count % MapEquations::parts] += block.transpose() * block;
    q.b_of[count % MapEquations::parts] -= block.transpose() * residual.segment(first, rows);
  }
  for (std::size_t p = 0; p < MapEquations::parts; ++p) {
    q.A += q.A_of[p];
    q.b += q.b_of[p];
  }
  return q;
}

/// Moves the values of a map by a step, or by a part of it that still helps.
void move_map(const Evaluation& evaluation, Hypothesis& h, const Eigen::VectorXd& step) {
  for (const double share : {1.0, 0.5, 0.25}) {
    Hypothesis trial = h;
    CubicTable& table = map_of(trial.drive)->table;
    std::vector<double> values = table.values();
    for (std::size_t k = 0; k < values.size(); ++k) values[k] += share * step[static_cast<Eigen::Index>(k)];
    table = CubicTable(table.points(), std::move(values));
    if (!evaluate(evaluation, trial) || trial.objective >= h.objective) continue;
    h = std::move(trial);
    return;
  }
}

/// Fits a map and, by turns, the noise and the stated numbers beside it.
void fit_map(const Evaluation& evaluation, Hypothesis& h, double torque, double smoothness) {
  for (int turn = 0; turn < 3; ++turn) {
    const MapEquations q = map_equations(evaluation, h, torque);
    move_map(evaluation, h, q.step(q.A, q.b, smoothness));
    adjust_noise(evaluation, h, 3);
    fit(evaluation, h, 2);
  }
}

/// A map of nothing yet, with the points and the smoothness that predict best what is left out; nothing where no map
/// does. sorted: the values of its axis.
std::optional<LearnedMap> chosen_by_parts(const Evaluation& evaluation, const Hypothesis& h, TorqueMap<double> map,
                                          const std::vector<double>& sorted, double torque) {
  std::optional<LearnedMap> best;
  double least = 0.0;  // what no map is worth
  for (const std::size_t count : rules::points_of_map) {
    const std::vector<double> points = points_among(sorted, count);
    if (points.size() < 4) continue;
    map.table = CubicTable(points, std::vector<double>(points.size(), 0.0));
    Hypothesis with = h;
    map_of(with.drive) = map;
    if (!evaluate(evaluation, with)) continue;
    const MapEquations q = map_equations(evaluation, with, torque);
    for (const double smoothness : rules::smoothness_of_map) {
      const double worth = q.left_out(smoothness);
      if (worth >= least) continue;
      least = worth;
      best = LearnedMap{with, 0.0, 0.0, smoothness};
    }
  }
  return best;
}

}  // namespace

std::optional<LearnedMap> learned_map(const Evaluation& evaluation, const Hypothesis& h, const Magnitudes& sizes) {
  std::optional<LearnedMap> best;
  if (map_of(h.drive)) return best;
  const double torque = rules::test_torque * sizes.torque,
               without = error_ahead(evaluation, h, rules::reported_horizon);
  std::vector<MapShaft> shafts{MapShaft::worm};
  if (sizes.has_teeth) shafts.push_back(MapShaft::gear);  // else one shaft is both
  for (const MapAxis over : {MapAxis::worm_speed, MapAxis::gear_angle}) {
    const std::vector<double> sorted = values_of_axis(evaluation, h, over);
    if (sorted.empty()) continue;
    for (const MapShaft shaft : shafts) {
      std::optional<LearnedMap> here = chosen_by_parts(evaluation, h, {over, 1.0, {}, shaft}, sorted, torque);
      if (!here) continue;
      fit_map(evaluation, here->model, torque, here->smoothness);
      here->without = without;
      here->with = error_ahead(evaluation, here->model, rules::reported_horizon);
      if (here->with < (1.0 - rules::of_no_account) * without && (!best || here->with < best->with))
        best = std::move(here);
    }
  }
  return best;
}

Hypothesis refined_map(const Evaluation& evaluation, const LearnedMap& map, Hypothesis h, const Magnitudes& sizes) {
  map_of(h.drive) = map_of(map.model.drive);
  if (evaluate(evaluation, h)) fit_map(evaluation, h, rules::test_torque * sizes.torque, map.smoothness);
  return h;
}

}  // namespace wormdrive
