#include "diagnosis/inference/resampled_draws.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/fitting/normal_equations.hpp"
#include "diagnosis/fitting/stepwise.hpp"
#include "diagnosis/inference/intervals.hpp"
#include "diagnosis/inference/sandwich.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "statistics/parallel.hpp"
#include "statistics/random.hpp"
#include "statistics/symmetric_eigen.hpp"

namespace wormdrive {

namespace {

/// What all draws have in common.
struct Common {
  Slopes J;                    ///< at the fit, over steps as long as standard errors
  Eigen::MatrixXd missing;     ///< factor of the covariance that weights of blocks do not make, in scales
  std::vector<double> errors;  ///< of coordinates in SI: of the predictor, and of those that have no slope
};

Common common(const Evaluation& evaluation, const Hypothesis& fit, const Eigen::MatrixXd& covariance) {
  Eigen::VectorXd variances = covariance.diagonal();
  for (Eigen::Index k = 0; k < variances.size(); ++k)
    variances[k] /= std::pow(fit.free[static_cast<std::size_t>(k)].scale, 2);
  Common c{central_sensitivities(evaluation, fit, steps_over_errors(variances)), {}, {}};
  Eigen::MatrixXd missing = sandwich(evaluation, fit, c.J).missing;
  for (Eigen::Index k = 0; k < c.J.cols(); ++k) {
    const auto q = static_cast<std::size_t>(k);
    const bool slopes = has_slope(fit.free[q]);
    c.errors.push_back(std::hypot(structural_error(fit, q), slopes ? 0.0 : std::sqrt(covariance(k, k))));
    if (slopes) continue;
    missing.row(k).setZero();
    missing.col(k).setZero();
  }
  const SymmetricEigen scatter = symmetric_eigen(missing);
  c.missing = scatter.vectors * scatter.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
  return c;
}

/// Random numbers of one draw.
class Numbers {
 public:
  Numbers(std::uint64_t seed, std::uint64_t draw) : seed_(seed), first_(draw << 32U) {}
  double exponential(std::uint64_t k) const { return -std::log(uniform(seed_, Stream::block_weights, first_ + k)); }
  double normal(std::uint64_t k) const { return wormdrive::normal(seed_, Stream::pulls, first_ + k); }

 private:
  std::uint64_t seed_, first_;
};

/// The data with other weights: what a draw is fitted to.
class Resampled {
 public:
  Resampled(const Evaluation& evaluation, const Common& all, const Hypothesis& fit, const Numbers& numbers)
      : evaluation_(evaluation), J_(all.J), h_(fit) {
    for (std::size_t b = 0; b < evaluation.layout().blocks; ++b) weights_.push_back(numbers.exponential(b));
    const double mean = std::accumulate(weights_.begin(), weights_.end(), 0.0) / static_cast<double>(weights_.size());
    for (double& w : weights_) w /= mean;
    for (std::size_t k = 0; k < h_.free.size(); ++k) h_.free[k].centre += h_.free[k].tolerance * numbers.normal(k);
    h_.objective = objective(h_);
  }

  /// The free coordinates that suit these weights best, by Gauss and Newton with the slopes at the fit: those over a
  /// standard error, for slopes found on the way would follow every event that passes a sample.
  std::vector<double> fitted() {
    for (int round = 0; round < rules::most_draw_rounds; ++round) {
      const auto [step, gain] = newton_step();
      if (!(gain > rules::least_draw_gain) || !follow(step)) break;
    }
    return h_.values;
  }

 private:
  double objective(const Hypothesis& h) const {
    const std::vector<double> blocks = misfit(evaluation_.layout(), h.residuals, h.noise_model).blocks;
    return with_tolerances(std::inner_product(blocks.begin(), blocks.end(), weights_.begin(), 0.0), h);
  }

  /// In scales, and what it promises in nats. A coordinate at a bound that pulls beyond it rests.
  std::pair<Eigen::VectorXd, double> newton_step() const {
    const InnovationLayout& layout = evaluation_.layout();
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(J_.cols(), J_.cols());
    Eigen::VectorXd b = Eigen::VectorXd::Zero(J_.cols()), row(J_.cols());
    const std::vector<double> curvature = fit_weights(layout, h_.residuals, h_.noise_model);
    for (std::size_t r = 0; r < layout.size; ++r) {
      const double weight = weights_[layout.block[r]] * curvature[r];
      if (!(weight > 0.0)) continue;
      row = J_.row(static_cast<Eigen::Index>(r)).transpose().cast<double>();
      A.noalias() += (weight * row) * row.transpose();
      b.noalias() -= weight * h_.residuals[r] * row;
    }
    add_tolerances(h_, A, b);
    for (Eigen::Index k = 0; k < b.size(); ++k) {
      const auto q = static_cast<std::size_t>(k);
      if (!(b[k] < 0.0 && h_.values[q] <= h_.free[q].low) && !(b[k] > 0.0 && h_.values[q] >= h_.free[q].high)) continue;
      A.row(k).setZero();
      A.col(k).setZero();
      A(k, k) = 1.0;
      b[k] = 0.0;
    }
    const Eigen::VectorXd step = solve_normal(A, b);
    return {step, 0.5 * b.dot(step)};
  }

  /// Goes a step as far as it gains; whether it does.
  bool follow(const Eigen::VectorXd& step) {
    for (const double share : {1.0, 0.3, 0.1, 0.03}) {
      Hypothesis trial = h_;
      for (std::size_t k = 0; k < trial.values.size(); ++k) {
        const Coordinate& c = trial.free[k];
        trial.values[k] =
            std::clamp(h_.values[k] + share * c.scale * step[static_cast<Eigen::Index>(k)], c.low, c.high);
      }
      const auto e = evaluation_.innovations(extended(trial), trial.noise);
      if (!e) continue;
      trial.residuals = whitened(evaluation_.layout(), *e, trial.noise_model);
      trial.objective = objective(trial);
      if (!(trial.objective < h_.objective)) continue;
      h_ = std::move(trial);
      return true;
    }
    return false;
  }

  const Evaluation& evaluation_;
  const Slopes& J_;
  Hypothesis h_;
  std::vector<double> weights_;  ///< of every block
};

/// Adds what weights do not tell: of the scatter what intervals have beyond it, and the errors.
void add_errors(const Common& all, const std::vector<Coordinate>& free, const Numbers& numbers,
                std::vector<double>& values) {
  const std::size_t n = values.size();
  Eigen::VectorXd z(all.missing.cols());
  for (std::size_t k = 0; k < n; ++k) z[static_cast<Eigen::Index>(k)] = numbers.normal(n + k);
  const Eigen::VectorXd beyond_weights = all.missing * z;
  for (std::size_t k = 0; k < n; ++k)
    values[k] = std::clamp(values[k] + free[k].scale * beyond_weights[static_cast<Eigen::Index>(k)] +
                               all.errors[k] * numbers.normal(2 * n + k),
                           free[k].low, free[k].high);
}

}  // namespace

std::vector<std::vector<double>> resampled_draws(const Evaluation& evaluation, const Hypothesis& fit,
                                                 const Eigen::MatrixXd& covariance, const JointEstimate& of, int draws,
                                                 std::uint64_t seed) {
  if (draws == 0 || of.numbers.empty()) return {};
  const Common all = common(evaluation, fit, covariance);
  std::vector<std::vector<double>> rows(static_cast<std::size_t>(draws));
  parallel_for(rows.size(), evaluation.threads(), [&](std::size_t k) {
    const Numbers numbers(seed, k);
    Hypothesis drawn = fit;
    drawn.values = Resampled(evaluation, all, fit, numbers).fitted();
    add_errors(all, fit.free, numbers, drawn.values);
    const RecordedDrive drive = extended(drawn);
    for (std::size_t q = 0; q < of.numbers.size(); ++q)
      rows[k].push_back(field_of(drive, of.effects[q], of.numbers[q].field).value);
  });
  return rows;
}

}  // namespace wormdrive
