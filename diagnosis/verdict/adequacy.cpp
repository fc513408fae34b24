#include "diagnosis/verdict/adequacy.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "diagnosis/data/moved_load.hpp"
#include "diagnosis/data/prepared_recording.hpp"
#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/fitting/prediction_error.hpp"
#include "diagnosis/rules/noise.hpp"
#include "diagnosis/rules/verdict.hpp"
#include "diagnosis/verdict/hat_functions.hpp"
#include "diagnosis/verdict/learned_vibration.hpp"
#include "diagnosis/verdict/spectral_line.hpp"
#include "statistics/parallel.hpp"

namespace wormdrive {

namespace {

/// What every sample of all recordings may be ordered by.
struct Abscissae {
  std::vector<double> angle, speed, time, load, direction, moving;
};

/// Calls visit(recording, k, t, angle, speed, load) for every sample, load in shares of the largest. The state is the
/// one that the predictor had before the sample: what is smoothed from later samples as well knows their noise, and
/// would find itself in it.
template <class Visit>
void for_each_state(const Evaluation& evaluation, const Hypothesis& h, const Magnitudes& sizes, Visit&& visit) {
  std::vector<FilteredStates> states;
  evaluation.innovations(extended(h), h.noise, {}, &states);
  for (std::size_t q = 0; q < states.size(); ++q) {
    const PreparedRecording& r = evaluation.layout().recordings[q];
    const FilteredStates& state = states[q];
    const auto drive = loaded_drive(evaluation.scenario(), r.data);
    auto load = drive.load();
    for (std::size_t k = 0; k < r.samples(); ++k) {
      const double t = r.data.time(k);
      load.enter(t);
      const double tau = sizes.load_torque > 0.0
                             ? load.torque(drive.moment(t, state.angle[k], state.speed[k])) / sizes.load_torque
                             : 0.0;
      visit(r, k, t, state.angle[k], state.speed[k], tau);
    }
  }
}

Abscissae abscissae(const Evaluation& evaluation, const Hypothesis& h, const Magnitudes& sizes) {
  Abscissae a;
  for_each_state(evaluation, h, sizes,
                 [&](const PreparedRecording& r, std::size_t k, double t, double angle, double speed, double load) {
                   a.angle.push_back(angle);
                   a.speed.push_back(speed);
                   a.time.push_back(t);
                   a.load.push_back(load);
                   a.direction.push_back(speed > 0.0 ? 1.0 : -1.0);
                   a.moving.push_back(r.moving[k]);
                 });
  return a;
}

/// On which flank the load presses, at every sample: 1 or -1.
std::vector<double> sides(const Evaluation& evaluation, const Hypothesis& h, const Magnitudes& sizes) {
  std::vector<double> all;
  for_each_state(evaluation, h, sizes,
                 [&](const PreparedRecording&, std::size_t, double, double, double speed, double load) {
                   all.push_back((speed > 0.0 ? load : -load) > 0.0 ? 1.0 : -1.0);
                 });
  return all;
}

/// A torque that is a free function of one axis, times one of several factors.
struct Axis1D {
  std::string name;
  const std::vector<double>* over;
  int nodes;
  std::vector<std::function<double(std::size_t)>> factors;
  bool one_place = false;  ///< the torque acts at one place of the axis, the one where it explains most
};

class Scores {
 public:
  Scores(const Evaluation& evaluation, const Hypothesis& h, double torque, bool keeps_torques)
      : evaluation_(evaluation),
        h_(h),
        torque_(torque),
        keeps_torques_(keeps_torques),
        free_(static_cast<Eigen::Index>(h.free.size())) {
    const InnovationLayout& layout = evaluation.layout();
    weight_ = fit_weights(layout, h.residuals, h.noise_model);
    for (double& w : weight_) w = std::sqrt(w);
    J_.resize(static_cast<Eigen::Index>(layout.size), free_);
    parallel_for(h.free.size(), evaluation.threads(), [&](std::size_t k) {
      J_.col(static_cast<Eigen::Index>(k)) =
          weighted(sensitivity(evaluation, h, k, derivative_step), rules::largest_change);
    });
    residual_ = weighted(h.residuals, 1e9);
  }

  ScoreTest operator()(const Axis1D& axis, const std::vector<double>& moving) const {
    const HatFunctions hat(*axis.over, axis.nodes);
    const auto tents = static_cast<std::size_t>(axis.nodes);
    const std::size_t m = tents * axis.factors.size();
    const std::size_t samples = evaluation_.layout().samples;
    const auto torque_at = [&](std::size_t q, std::size_t k) {
      return torque_ * hat(q % tents, k) * axis.factors[q / tents](k) * moving[k];
    };
    Eigen::MatrixXd V(J_.rows(), free_ + static_cast<Eigen::Index>(m));
    V.leftCols(free_) = J_;
    parallel_for(m, evaluation_.threads(), [&](std::size_t q) {
      std::vector<double> torque(samples);
      for (std::size_t k = 0; k < samples; ++k) torque[k] = torque_at(q, k);
      const auto e = evaluation_.innovations(extended(h_), h_.noise, torque);
      V.col(free_ + static_cast<Eigen::Index>(q)) =
          e ? weighted(difference(evaluation_, h_, *e), rules::clip_of_test) : Eigen::VectorXd::Zero(J_.rows());
    });
    std::vector<std::size_t> used(m);
    std::iota(used.begin(), used.end(), 0);
    if (axis.one_place) used = {keep_strongest(V)};
    ScoreTest test;
    test.what.axis = axis.name;
    const auto degrees = static_cast<double>(used.size());
    const Solved all = solve(V, V.cols(), false), less = solve(V, free_, false);
    test.what.gain = 0.5 * (all.score - less.score);
    test.what.evidence = axis.one_place ? test.what.gain - std::log(static_cast<double>(m))
                                        : (2.0 * test.what.gain - degrees) / std::sqrt(2.0 * degrees);
    const auto sum = [&](const Eigen::VectorXd& x) {
      std::vector<double> torque(samples, 0.0);
      for (std::size_t q = 0; q < used.size(); ++q)
        for (std::size_t k = 0; k < samples; ++k)
          torque[k] += x[free_ + static_cast<Eigen::Index>(q)] * torque_at(used[q], k);
      return torque;
    };
    const Eigen::VectorXd kept = solve(V, V.cols(), true).x;
    test.held_out = held_out_gain(V, kept);
    if (keeps_torques_ && !axis.one_place) test.torque = sum(kept);  // of a place few blocks tell
    const double count = std::accumulate(moving.begin(), moving.end(), 0.0);
    double squares = 0.0;
    for (const double torque : sum(all.x)) squares += torque * torque;
    test.what.torque = std::sqrt(squares / std::max(1.0, count));
    return test;
  }

 private:
  struct Solved {
    Eigen::VectorXd x;
    double score;
  };

  Eigen::VectorXd weighted(const std::vector<double>& column, double most_scales) const {
    Eigen::VectorXd w(static_cast<Eigen::Index>(column.size()));
    for (std::size_t k = 0; k < column.size(); ++k) {
      const double limit = most_scales * h_.noise_model.groups[evaluation_.layout().group[k]].scale;
      w[static_cast<Eigen::Index>(k)] = weight_[k] * std::clamp(column[k], -limit, limit);
    }
    return w;
  }

  Solved solve(const Eigen::MatrixXd& V, Eigen::Index columns, bool less_held_out) const {
    Eigen::MatrixXd A;
    Eigen::VectorXd b;
    const auto part = V.leftCols(columns);
    if (!less_held_out) {
      A = part.transpose() * part;
      b = -part.transpose() * residual_;
    } else {
      A = Eigen::MatrixXd::Zero(columns, columns);
      b = Eigen::VectorXd::Zero(columns);
      for_each_stretch(evaluation_.layout().block, [&](std::size_t block, Eigen::Index first, Eigen::Index rows) {
        if (is_held_out(block)) return;
        A += part.middleRows(first, rows).transpose() * part.middleRows(first, rows);
        b -= part.middleRows(first, rows).transpose() * residual_.segment(first, rows);
      });
    }
    add_tolerances(h_, A, b);
    for (Eigen::Index k = free_; k < columns; ++k) A(k, k) += rules::precision_of_hat;
    const Eigen::VectorXd x = columns > 0 ? solve_normal(A, b, 1e-6) : Eigen::VectorXd(0);
    return {x, columns > 0 ? x.dot(b) : 0.0};
  }

  /// Leaves of all torques the one that explains most, and says which it is.
  std::size_t keep_strongest(Eigen::MatrixXd& V) const {
    Eigen::MatrixXd one = V.leftCols(free_ + 1);
    std::size_t best = 0;
    double most = -1.0;
    for (std::size_t q = 0; q < static_cast<std::size_t>(V.cols() - free_); ++q) {
      one.col(free_) = V.col(free_ + static_cast<Eigen::Index>(q));
      const double score = solve(one, one.cols(), false).score;
      if (score <= most) continue;
      most = score;
      best = q;
    }
    one.col(free_) = V.col(free_ + static_cast<Eigen::Index>(best));
    V = std::move(one);
    return best;
  }

  /// Gain of every third block by a torque that was fitted to the others, kept.
  double held_out_gain(const Eigen::MatrixXd& V, const Eigen::VectorXd& kept) const {
    const Eigen::VectorXd with = residual_ + V * kept;
    const Eigen::VectorXd without = residual_ + V.leftCols(free_) * solve(V, free_, true).x;
    double gain = 0.0;
    for (Eigen::Index r = 0; r < V.rows(); ++r)
      if (is_held_out(evaluation_.layout().block[static_cast<std::size_t>(r)]))
        gain += 0.5 * (without[r] * without[r] - with[r] * with[r]);
    return gain;
  }

  const Evaluation& evaluation_;
  const Hypothesis& h_;
  double torque_;
  bool keeps_torques_;
  Eigen::Index free_;
  std::vector<double> weight_;
  Eigen::MatrixXd J_;
  Eigen::VectorXd residual_;
};

}  // namespace

std::vector<ScoreTest> score_tests(const Evaluation& evaluation, const Hypothesis& h, const Magnitudes& sizes,
                                   bool keep_torques) {
  const Abscissae a = abscissae(evaluation, h, sizes);
  const auto factor = [](const std::vector<double>& values) { return [&values](std::size_t k) { return values[k]; }; };
  const auto one = [](std::size_t) { return 1.0; };
  const auto loaded_side = [&a](std::size_t k) { return std::abs(a.load[k]) * a.direction[k]; };
  std::vector<Axis1D> axes{{"angle and direction", &a.angle, rules::hats_over_angle, {one, factor(a.direction)}},
                           {"speed", &a.speed, rules::hats_over_speed, {one}}};
  if (sizes.load_torque > 0.0) {
    axes.push_back({"time", &a.time, rules::hats_over_time, {one, factor(a.load), loaded_side}});
    axes.push_back({"speed and load", &a.speed, rules::hats_over_time, {factor(a.load), loaded_side}});
    axes.push_back({"one angle", &a.angle, rules::spots, {loaded_side}, true});
  } else {
    axes.push_back({"time", &a.time, rules::hats_over_time, {one, factor(a.direction)}});
    axes.push_back({"one angle", &a.angle, rules::spots, {factor(a.direction)}, true});
  }
  const Scores scores(evaluation, h, rules::test_torque * sizes.torque, keep_torques);
  std::vector<ScoreTest> all;
  const double least_torque =
      sizes.torque * (sizes.has_worm_encoder ? rules::left_torque_of_two_encoders : rules::left_torque);
  for (const Axis1D& axis : axes) {
    all.push_back(scores(axis, a.moving));
    ScoreTest& test = all.back();
    test.found = test.what.evidence > (axis.one_place ? rules::left_place : rules::left_deviations) &&
                 test.held_out > (axis.one_place ? rules::left_gain_of_a_place : rules::left_gain) &&
                 test.what.torque > least_torque;
  }
  return all;
}

std::vector<double> shares_of_error(const Evaluation& evaluation, const Hypothesis& h, const Magnitudes& sizes,
                                    const std::vector<Remainder>& remainders) {
  std::vector<double> shares(remainders.size(), std::numeric_limits<double>::infinity());
  const auto is_line = [](const Remainder& r) { return r.frequency > 0.0; };
  if (!std::all_of(remainders.begin(), remainders.end(), is_line))
    for (const ScoreTest& test : score_tests(evaluation, h, sizes, true))
      for (std::size_t k = 0; k < shares.size(); ++k)
        if (!test.torque.empty() && test.what.axis == remainders[k].axis)
          shares[k] = share_of_error(evaluation, h, rules::reported_horizon, test.torque);
  if (std::any_of(remainders.begin(), remainders.end(), is_line)) {
    Hypothesis shaken = h;
    if (!learned_vibration(evaluation, shaken, sizes))
      for (std::size_t k = 0; k < shares.size(); ++k)
        if (is_line(remainders[k])) shares[k] = 0.0;
  }
  return shares;
}

std::vector<Remainder> strongest_first(std::vector<Remainder> all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Remainder& x, const Remainder& y) { return x.evidence > y.evidence; });
  return all;
}

std::vector<Remainder> remainders(const Evaluation& all, const Hypothesis& h, const Evaluation& pieces,
                                  const Magnitudes& sizes) {
  std::vector<Remainder> found;
  Hypothesis there = h;
  if (evaluate(pieces, there))
    for (const ScoreTest& test : score_tests(pieces, there, sizes))
      if (test.found) found.push_back(test.what);
  for (const ScoreTest& line : spectral_lines(all, h))  // judged by what it does as a vibration
    if (line.what.evidence > rules::left_line) found.push_back(line.what);
  const std::vector<double> side = sides(all, h, sizes);
  for (std::size_t r = 0; r < all.layout().recordings.size(); ++r)
    if (const ScoreTest line = spectral_line(all, h, r, &side, "a line by flank");
        line.what.evidence > rules::left_line && line.ahead > rules::left_ahead)
      found.push_back(line.what);
  return strongest_first(std::move(found));
}

}  // namespace wormdrive
