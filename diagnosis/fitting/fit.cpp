#include "diagnosis/fitting/fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "diagnosis/fitting/prediction_error.hpp"
#include "diagnosis/fitting/stepwise.hpp"
#include "diagnosis/predictor/noise_tails.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "diagnosis/rules/noise.hpp"
#include "statistics/parallel.hpp"

namespace wormdrive {

void add_tolerances(const Hypothesis& h, Eigen::MatrixXd& A, Eigen::VectorXd& b) {
  for (std::size_t k = 0; k < h.free.size(); ++k) {
    const Coordinate& c = h.free[k];
    if (c.tolerance <= 0.0) continue;
    const double share = c.scale / c.tolerance;
    const auto i = static_cast<Eigen::Index>(k);
    A(i, i) += share * share;
    b[i] -= share * (h.values[k] - c.centre) / c.tolerance;
  }
}

namespace {

void follow_slopes(const Evaluation& evaluation, Hypothesis& h, int rounds, double least_gain) {
  const std::size_t n = h.free.size();
  double damping = 1e-3;
  for (int round = 0; round < rounds; ++round) {
    const WeightedColumns weigh(fit_weights(evaluation.layout(), h.residuals, h.noise_model));
    const Eigen::VectorXd residual = weigh(h.residuals);
    Eigen::MatrixXf J = Eigen::MatrixXf::Zero(residual.size(), static_cast<Eigen::Index>(n));
    parallel_for(n, evaluation.threads(), [&](std::size_t k) {
      if (has_slope(h.free[k]))
        J.col(static_cast<Eigen::Index>(k)) = weigh(sensitivity(evaluation, h, k, derivative_step)).cast<float>();
    });
    auto [A, b] = NormalEquations(J, residual);
    add_tolerances(h, A, b);

    const double before = h.objective;
    bool better = false;
    for (int attempt = 0; attempt < 4 && !better; ++attempt) {
      const Eigen::VectorXd step = solve_normal(A, b, damping);
      if (0.5 * b.dot(step) < rules::nothing_to_gain * least_gain) return;
      Hypothesis trial = h;
      for (std::size_t k = 0; k < n; ++k) {
        constexpr double longest = 20.0;  // scales
        const double by_scale = std::clamp(step[static_cast<Eigen::Index>(k)], -longest, longest);
        trial.values[k] = std::clamp(h.values[k] + by_scale * h.free[k].scale, h.free[k].low, h.free[k].high);
      }
      better = evaluate(evaluation, trial) && trial.objective < h.objective;
      if (better) h = std::move(trial);
      damping = better ? std::max(0.1 * damping, 1e-6) : std::max(10.0 * damping, 1e-2);
    }
    if (!better || before - h.objective < least_gain) return;
  }
}

}  // namespace

void fit(const Evaluation& evaluation, Hypothesis& h, int rounds, double least_gain) {
  if (!evaluate(evaluation, h) || h.free.empty()) return;
  follow_slopes(evaluation, h, rounds, least_gain);
  if (search_steps(evaluation, h)) follow_slopes(evaluation, h, rounds, least_gain);
}

namespace {

double most_process_noise(const Evaluation& evaluation) {
  const std::vector<PreparedRecording>& all = evaluation.layout().recordings;
  const bool repeats =
      std::any_of(all.begin(), all.end(), [](const PreparedRecording& r) { return !r.shares.empty(); });
  return repeats ? rules::most_process_noise_of_steps : rules::most_process_noise;
}

}  // namespace

void adjust_noise(const Evaluation& evaluation, Hypothesis& h, int depth) {
  const double most = most_process_noise(evaluation);
  for (double ProcessNoise::*kind : {&ProcessNoise::white, &ProcessNoise::coloured})
    for (const double factor : {2.0, 0.5}) {
      bool any = false;
      for (int k = 0; k < depth; ++k) {
        Hypothesis trial = h;
        trial.noise.*kind *= factor;
        if (trial.noise.white < rules::least_process_noise || trial.noise.white > most || trial.noise.coloured > most)
          break;
        if (!evaluate(evaluation, trial) || trial.objective >= h.objective - rules::least_noise_gain) break;
        h = std::move(trial);
        any = true;
      }
      if (any) break;
    }
}

Hypothesis with_least_noise(const Evaluation& evaluation, Hypothesis h, bool is_overstated) {
  const auto lower_while = [&](auto&& suffices) {
    const auto try_with = [&](Hypothesis& less, double white, double coloured) {
      less.noise.white = white;
      less.noise.coloured = coloured;
      return evaluate(evaluation, less) && suffices(less);
    };
    for (double size; (size = 0.5 * std::hypot(h.noise.white, h.noise.coloured)) >= rules::least_process_noise;) {
      Hypothesis less = h;
      bool found = try_with(less, 0.5 * h.noise.white, 0.5 * h.noise.coloured);
      // data tell hardly which kind it is, but one that lasts is much smaller for what it does
      if (h.noise.white > rules::least_process_noise)
        for (; !found && size >= rules::least_process_noise; size *= 0.5)
          found = try_with(less, rules::least_process_noise, size);
      if (!found) return;
      h = std::move(less);
    }
  };
  const double enough = h.misfit.fitted + rules::of_process_noise;
  lower_while([&](const Hypothesis& less) { return less.misfit.fitted <= enough; });
  if (!is_overstated && !mostly_rounding(h.noise_model)) return h;
  // errors of rounding are not white, and as likely by a torque as by themselves; predictions tell
  const double error = error_ahead(evaluation, h, rules::reported_horizon);
  lower_while([&](const Hypothesis& less) { return error_ahead(evaluation, less, rules::reported_horizon) <= error; });
  return h;
}

bool explains_better(const Hypothesis& h, const Hypothesis& other) {
  const auto cost = [](const Hypothesis& x) {
    return x.objective + (hides_what_is_slow(x.noise_model) ? rules::of_process_noise : 0.0);
  };
  return cost(h) < cost(other);
}

void restart_noise(const Evaluation& evaluation, Hypothesis& h) {
  const auto try_with = [&](double white, double coloured) {
    Hypothesis trial = h;
    trial.noise.white = white;
    trial.noise.coloured = coloured;
    if (evaluate(evaluation, trial) && explains_better(trial, h)) h = std::move(trial);
  };
  using Starts = std::array<ProcessNoise, 3>;
  const Starts starts = h.whitens ? Starts{{{0.01, 0.006}, {0.03, 0.003}, {0.003, 0.01}}}
                                  : Starts{{{0.02, 0.0}, {0.005, 0.0}, {0.1, 0.0}}};
  for (const ProcessNoise& start : starts) try_with(start.white, start.coloured);
  if (!hides_what_is_slow(h.noise_model)) return;
  const ProcessNoise hiding = h.noise;
  const double most = most_process_noise(evaluation);
  for (double coloured = 2.0 * hiding.coloured; coloured <= most; coloured *= 2.0) try_with(hiding.white, coloured);
}

}  // namespace wormdrive
