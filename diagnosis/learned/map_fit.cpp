#include "diagnosis/learned/map_fit.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/rules/verdict.hpp"
#include "statistics/parallel.hpp"

namespace wormdrive {

namespace {

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

/// Of a hypothesis whose map is on.
MapEquations map_equations(const Evaluation& evaluation, const Hypothesis& h, const LearnedMap& map) {
  const std::vector<double>& points = map.points;
  const auto n = static_cast<Eigen::Index>(points.size());
  const std::vector<double> weights = fit_weights(evaluation.layout(), h.residuals, h.noise_model);
  const WeightedColumns weigh(weights);
  const Eigen::VectorXd residual = weigh(h.residuals);
  Eigen::MatrixXf V = Eigen::MatrixXf::Zero(residual.size(), n);  // of hours of samples, so not in doubles
  parallel_for(points.size(), evaluation.threads(), [&](std::size_t k) {
    RecordedDrive drive = extended(h);
    LearnedMap moved = map;
    moved.values[k] += map.form.step;
    put_on(drive, moved);
    if (const auto e = evaluation.innovations(drive, h.noise))
      V.col(static_cast<Eigen::Index>(k)) = (weigh(difference(evaluation, h, *e)) / map.form.step).cast<float>();
  });

  MapEquations q;
  q.values = Eigen::Map<const Eigen::VectorXd>(map.values.data(), n);
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
  std::size_t next = 0;
  for_each_stretch(blocks, [&](std::size_t, Eigen::Index first, Eigen::Index rows) {
    const Eigen::MatrixXd block = V.middleRows(first, rows).cast<double>();
    const std::size_t p = next++ % MapEquations::parts;
    q.A_of[p] += block.transpose() * block;
    q.b_of[p] -= block.transpose() * residual.segment(first, rows);
  });
  for (std::size_t p = 0; p < MapEquations::parts; ++p) {
    q.A += q.A_of[p];
    q.b += q.b_of[p];
  }
  return q;
}

/// Moves the values of a map by a step, or by a part of it that still helps.
void move_map(const Evaluation& evaluation, Hypothesis& h, LearnedMap& map, const Eigen::VectorXd& step) {
  for (const double share : {1.0, 0.5, 0.25}) {
    Hypothesis trial = h;
    LearnedMap moved = map;
    for (std::size_t k = 0; k < moved.values.size(); ++k) moved.values[k] += share * step[static_cast<Eigen::Index>(k)];
    put_on(trial.drive, moved);
    if (!evaluate(evaluation, trial) || trial.objective >= h.objective) continue;
    h = std::move(trial);
    map = std::move(moved);
    return;
  }
}

}  // namespace

void put_on(RecordedDrive& drive, const LearnedMap& map) { map.form.put(drive, CubicTable(map.points, map.values)); }

std::optional<LearnedMap> chosen_by_parts(const Evaluation& evaluation, const Hypothesis& h, const MapForm& form,
                                          const std::vector<double>& sorted, std::span<const std::size_t> counts) {
  std::optional<LearnedMap> best;
  double least = 0.0;  // what no map is worth
  for (const std::size_t count : counts) {
    LearnedMap map{form, points_among(sorted, count)};
    if (map.points.size() < 4) continue;
    map.values.assign(map.points.size(), 0.0);
    Hypothesis with = h;
    put_on(with.drive, map);
    if (!evaluate(evaluation, with)) continue;
    const MapEquations q = map_equations(evaluation, with, map);
    bool better = false;
    for (const double smoothness : rules::smoothness_of_map) {
      map.left_out = q.left_out(smoothness);
      if (map.left_out >= least) continue;
      least = map.left_out;
      map.smoothness = smoothness;
      best = map;
      better = true;
    }
    if (best && !better) break;  // more points tell no more
  }
  return best;
}

void fit_map(const Evaluation& evaluation, Hypothesis& h, LearnedMap& map) {
  put_on(h.drive, map);
  if (!evaluate(evaluation, h)) return;
  for (int turn = 0; turn < 3; ++turn) {
    const MapEquations q = map_equations(evaluation, h, map);
    move_map(evaluation, h, map, q.step(q.A, q.b, map.smoothness));
    adjust_noise(evaluation, h, 3);
    fit(evaluation, h, 2);
  }
}

}  // namespace wormdrive
