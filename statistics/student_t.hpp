#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace wormdrive {

/// Student's t distribution of residuals, whose tails forgive single outliers; constants that no model changes are
/// left out.
struct StudentT {
  double nu = 4.0;  ///< degrees of freedom

  /// Negative log likelihood of a residual e at a scale s [nats].
  double nll(double e, double s) const {
    const double z = e / s;
    return std::log(s) + 0.5 * (nu + 1.0) * std::log1p(z * z / nu);
  }
  /// What nll() leaves out because it depends on the degrees of freedom alone [nats].
  double normalization() const;
  /// Weight of a residual in a least squares step.
  double weight(double e, double s) const {
    const double z = e / s;
    return (nu + 1.0) / (nu + z * z);
  }
  /// A residual whose half square is the negative log likelihood less ln s: least squares then maximise the likelihood.
  double as_normal(double e, double s) const {
    const double z = e / s;
    return std::copysign(std::sqrt((nu + 1.0) * std::log1p(z * z / nu)), e);
  }
  /// Information that one residual carries on average, per squared slope and at scale 1.
  double information() const { return (nu + 1.0) / (nu + 3.0); }

  /// Most likely scale of residuals, at least `least`: a fixed point of its equation, from a start.
  double scale(const std::vector<double>& residuals, double start, double least) const {
    double s = std::max(start, least);
    for (int k = 0; k < 50; ++k) {
      double sum = 0.0;
      for (const double e : residuals) sum += weight(e, s) * e * e;
      const double next = std::max(least, std::sqrt(sum / static_cast<double>(residuals.size())));
      const bool still = std::abs(next - s) <= 1e-6 * s;
      s = next;
      if (still) break;
    }
    return s;
  }
};

/// Bayesian information criterion of a model with that many free parameters over so many data, in twice nats.
inline double bic(double nll, double parameters, double data) { return 2.0 * nll + parameters * std::log(data); }

/// Standard deviations that hold 95 % of an estimate whose variance is known from so many free data.
double t_quantile(std::size_t degrees);

}  // namespace wormdrive
