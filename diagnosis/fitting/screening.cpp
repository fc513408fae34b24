#include "diagnosis/fitting/screening.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "diagnosis/rules/noise.hpp"
#include "statistics/parallel.hpp"

namespace wormdrive {

namespace {

/// One candidate from one start.
class Trial {
 public:
  Trial(const Evaluation& evaluation, const Hypothesis& h, const std::vector<Candidate>& all, Screened& result)
      : evaluation_(evaluation), h_(h), candidate_(all[result.candidate]), result_(result), with_(h) {
    add_candidate(with_, all, result.candidate, result.start);
    with_ = not_evaluated(std::move(with_));
    if (candidate_.impacts && !result_.is_far) find_start();
  }

  void operator()(const WeightedColumns& weigh, const Eigen::MatrixXd& J, const Eigen::VectorXd& residual) {
    if (result_.is_far) {  // so far off no slope at the hypothesis says anything
      predict(with_);
      result_.model = with_;
      result_.gain = h_.bic - with_.bic;
      return;
    }
    collect_signatures();
    for (const auto& signature : signatures_) result_.signatures.emplace_back(signature.begin(), signature.end());
    const auto old = J.cols(), fresh = static_cast<Eigen::Index>(signatures_.size());
    Eigen::MatrixXd all(J.rows(), old + fresh);
    all.leftCols(old) = J;
    for (Eigen::Index k = 0; k < fresh; ++k) all.col(old + k) = weigh(signatures_[static_cast<std::size_t>(k)]);
    Eigen::MatrixXd A = all.transpose() * all;
    Eigen::VectorXd b = -all.transpose() * residual;
    Hypothesis tolerances = with_;  // signatures stand for the new coordinates, which have none
    tolerances.free.resize(h_.free.size());
    add_tolerances(tolerances, A, b);
    const Eigen::VectorXd step = solve_normal(A, b, 1e-6);
    const double promised = b.dot(step) + lifted_tolerance(), price = added_terms();
    // where a spring is slack shows only once it has a stiffness: then a step does not promise all that there is
    const bool promises_all = !candidate_.finite && (A.diagonal().tail(fresh).array() > 0.0).all();
    if (promises_all && promised < rules::least_promise * price) {
      result_.model = moved(step, 1.0);  // a prediction would say no more
      result_.gain = promised - price;
      return;
    }
    result_.model = not_evaluated(with_);
    const auto gains = [&] { return result_.model.objective < h_.objective - 1.0; };
    for (const double share : {1.0, 0.4}) {
      keep_better(moved(step, share));
      if (gains()) break;
    }
    // stated numbers that have given way for it lie along a valley, which bends
    if (promises_all && !gains() && promised - price > rules::least_bic) fit(evaluation_, result_.model, 3);
    if (candidate_.finite && !candidate_.either_sign) keep_better(with_);
    result_.gain = h_.bic - result_.model.bic;
  }

 private:
  static Hypothesis not_evaluated(Hypothesis h) {
    h.objective = h.bic = std::numeric_limits<double>::infinity();
    return h;
  }

  /// Predicts by a trial; with noise of its own where the hypothesis has so much that it stands for the motion.
  void predict(Hypothesis& trial) const {
    evaluate(evaluation_, trial);
    if (std::hypot(h_.noise.white, h_.noise.coloured) > rules::strong_process_noise) restart_noise(evaluation_, trial);
  }

  /// The best size of a section of sizes: a gap that is off by a third may promise nothing. Teeth that bounce little
  /// leave the smoothest likelihood.
  void find_start() {
    with_.noise.impact.restitution = rules::smooth_restitution;
    const Hypothesis middle = with_;
    for (const double factor : {1.0 / rules::gap_step, 1.0, rules::gap_step}) {
      Hypothesis trial = middle;
      const Coordinate& c = trial.free[h_.free.size()];
      double& gap = trial.values[h_.free.size()];
      gap = std::clamp(factor * gap, c.low, c.high);
      predict(trial);
      if (trial.objective < with_.objective) with_ = std::move(trial);
    }
  }

  void collect_signatures() {
    const std::size_t old = h_.free.size();
    size_ = old;
    if (candidate_.finite) {
      const bool moves = !std::isinf(with_.objective) || evaluate(evaluation_, with_);
      signatures_.push_back(moves ? difference(evaluation_, h_, with_.innovations)
                                  : std::vector<double>(h_.innovations.size(), 0.0));
      return;
    }
    Hypothesis moved = with_;
    moved.innovations = h_.innovations;
    moved.noise_model = h_.noise_model;
    for (std::size_t k = old; k < with_.free.size(); ++k)
      signatures_.push_back(sensitivity(evaluation_, moved, k, 5.0 * derivative_step));
  }

  /// What a stated parameter that has moved costs as long as it has its tolerance, as BIC.
  double lifted_tolerance() const { return 2.0 * (with_tolerances(0.0, h_) - with_tolerances(0.0, with_)); }

  /// What the coordinates that are free here and not in the hypothesis cost, as BIC.
  double added_terms() const {
    const auto unknown = [](const Hypothesis& h) {
      return std::count_if(h.free.begin(), h.free.end(), [](const Coordinate& c) { return c.tolerance <= 0.0; });
    };
    return static_cast<double>(unknown(with_) - unknown(h_)) *
               std::log(static_cast<double>(evaluation_.layout().fitted())) +
           with_.choices - h_.choices;
  }

  /// The candidate and what was free before, moved by a share of a step.
  Hypothesis moved(const Eigen::VectorXd& step, double share) const {
    Hypothesis trial = with_;
    const auto move = [&](std::size_t k, double by_scales) {
      const Coordinate& c = trial.free[k];
      trial.values[k] = std::clamp(trial.values[k] + by_scales * c.scale, c.low, c.high);
    };
    for (std::size_t k = 0; k < h_.free.size(); ++k)
      move(k, share * std::clamp(step[static_cast<Eigen::Index>(k)], -20.0, 20.0));
    for (std::size_t q = 0; q < signatures_.size(); ++q) {
      const double length = share * std::clamp(step[static_cast<Eigen::Index>(h_.free.size() + q)], -30.0, 30.0);
      if (!candidate_.finite) {
        move(size_ + q, length);
      } else if (candidate_.resizable) {
        const Coordinate& c = trial.free[size_];
        trial.values[size_] =
            std::clamp(trial.values[size_] * std::max(candidate_.either_sign ? -30.0 : 0.05, length), c.low, c.high);
      }
    }
    return not_evaluated(std::move(trial));
  }

  void keep_better(Hypothesis trial) {
    if (std::isinf(trial.objective)) evaluate(evaluation_, trial);
    if (trial.objective < result_.model.objective || std::isinf(result_.model.objective))
      result_.model = std::move(trial);
  }

  const Evaluation& evaluation_;
  const Hypothesis& h_;
  const Candidate& candidate_;
  Screened& result_;
  Hypothesis with_;
  std::vector<std::vector<double>> signatures_{};
  std::size_t size_ = 0;  ///< the candidate's first coordinate among the free ones
};

/// How many far values of a candidate are tried. A recording that is so wrong comes before anything else.
std::size_t far_values(const Hypothesis& h, const Candidate& candidate) {
  return candidate.of_recording && !h.causes.empty() ? 0 : candidate.far.size();
}

}  // namespace

bool is_in(const Hypothesis& h, const std::vector<Candidate>& all, std::size_t candidate) {
  if (std::find(h.causes.begin(), h.causes.end(), candidate) != h.causes.end()) return true;
  return std::all_of(all[candidate].coordinates.begin(), all[candidate].coordinates.end(), [&](const Coordinate& c) {
    const int k = index_of(h, c);
    return k >= 0 && h.free[static_cast<std::size_t>(k)].tolerance <= 0.0;
  });
}

Screening screen(const Evaluation& evaluation, const Hypothesis& h, const std::vector<Candidate>& all) {
  Screening s;
  s.free_columns.resize(h.free.size());
  parallel_for(h.free.size(), evaluation.threads(),
               [&](std::size_t k) { s.free_columns[k] = sensitivity(evaluation, h, k, derivative_step); });
  const WeightedColumns weigh(fit_weights(evaluation.layout(), h.residuals, h.noise_model));
  const Eigen::VectorXd residual = weigh(h.residuals);
  Eigen::MatrixXd J(residual.size(), static_cast<Eigen::Index>(h.free.size()));
  for (std::size_t k = 0; k < h.free.size(); ++k) J.col(static_cast<Eigen::Index>(k)) = weigh(s.free_columns[k]);

  for (std::size_t c = 0; c < all.size(); ++c)
    if (!all[c].alone && !is_in(h, all, c))
      for (std::size_t start = 0; start < all[c].starts.size() + far_values(h, all[c]); ++start)
        s.found.push_back({.candidate = c, .start = start, .is_far = start >= all[c].starts.size()});
  parallel_for(s.found.size(), evaluation.threads(), [&](std::size_t k) {
    Trial(evaluation, h, all, s.found[k])(weigh, J, residual);
    s.found[k].model.innovations = std::vector<double>();  // gives its memory back, as {} would not
    s.found[k].model.residuals = std::vector<double>();
  });
  std::stable_sort(s.found.begin(), s.found.end(), [](const auto& a, const auto& b) { return a.gain > b.gain; });
  return s;
}

}  // namespace wormdrive
