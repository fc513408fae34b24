#include "diagnosis/predictor/observer_gains.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Core>

#include "diagnosis/data/sample_times.hpp"
#include "diagnosis/rules/noise.hpp"
#include "diagnosis/rules/recordings.hpp"

namespace wormdrive {

namespace {

/// Without a coloured torque the gains have a closed form [Kalata 1984, the tracking index of an alpha-beta filter].
ObserverGains alpha_beta(double index, double keep) {
  const double r = (4.0 + index - std::sqrt(8.0 * index + index * index)) / 4.0;
  const double alpha = 1.0 - r * r;
  return {alpha, 2.0 * (2.0 - alpha) - 4.0 * std::sqrt(1.0 - alpha), 0.0, keep};
}

/// A step of the double integrator, in units of the usual one.
struct Propagation {
  Eigen::Matrix3d F, Q;

  /// keep: share of the coloured torque that is left after it. A torque that is new at every sample is the weaker the
  /// longer it lasts, for its spectrum is what is given.
  Propagation(const ProcessNoise& noise, double length, double keep) {
    const double h = length, white = noise.white * noise.white / h, coloured = noise.coloured * noise.coloured;
    F << 1.0, h, 0.5 * h * h, 0.0, 1.0, h, 0.0, 0.0, keep;
    Q = Eigen::Matrix3d::Zero();
    const double h2 = h * h;
    Q.topLeftCorner<2, 2>() << 0.25 * h2 * h2 * white, 0.5 * h2 * h * white, 0.5 * h2 * h * white, h2 * white;
    Q(2, 2) = coloured * (1.0 - keep * keep);
  }
  Eigen::Matrix3d ahead(const Eigen::Matrix3d& P) const { return F * P * F.transpose() + Q; }
};

/// Whether one pair of gains serves every sample.
bool is_steady(const Recording& r) {
  if (!r.restarts.empty() || std::find(r.valid.begin(), r.valid.end(), 0) != r.valid.end()) return false;
  for (std::size_t k = 1; k < r.times.size(); ++k)
    if (std::abs(r.times[k] - r.times[k - 1] - r.period) > rules::even_enough * r.period) return false;
  return true;
}

}  // namespace

ProcessNoise ProcessNoise::over(double other) const {
  ProcessNoise noise = *this;
  noise.period = other;
  if (period == 0.0 || std::abs(other - period) <= rules::even_enough * period) return noise;
  const double longer = other / period;
  noise.white *= longer * std::sqrt(longer);
  noise.coloured *= longer * longer;
  return noise;
}

ObserverGains observer_gains(const ProcessNoise& stated, double period) {
  const ProcessNoise noise = stated.over(period);
  const double a = std::exp(-period / rules::colouring_time);
  if (noise.coloured <= 0.0) return alpha_beta(noise.white, a);
  const Propagation step(noise, 1.0, a);
  Eigen::Matrix3d P = Eigen::Vector3d(1.0, 0.1, noise.coloured * noise.coloured).asDiagonal();
  Eigen::Vector3d K = Eigen::Vector3d::Zero(), before = K;
  constexpr int most = 4000, look_every = 20;
  for (int k = 1; k <= most; ++k) {
    const Eigen::Matrix3d ahead = step.ahead(P);
    K = ahead.col(0) / (ahead(0, 0) + 1.0);
    P = ahead - K * ahead.row(0);
    if (k % look_every != 0) continue;
    if ((K - before).cwiseAbs().maxCoeff() <= 1e-7 * K[0] || (K - before).isZero(1e-15)) break;
    before = K;
  }
  return {K[0], K[1], K[2], a};
}

std::vector<ObserverGains> observer_gains(const ProcessNoise& stated, const PreparedRecording& prepared) {
  const Recording& recording = prepared.data;
  if (prepared.shares.empty() && is_steady(recording)) return {observer_gains(stated, recording.period)};
  const ProcessNoise noise = stated.over(recording.period);
  // The angle is a reading of the sensor. The speed, of a line through samples between which the motion may bend, is as
  // good as unknown: what follows tells it.
  constexpr double unknown = 1e8;
  // Steps whose lengths differ by the rounding of their times are alike. Gains that change by less from sample to
  // sample add up to no more than floats show.
  constexpr double alike = 1e-6, still = 1e-10;
  const Eigen::Matrix3d at_start = Eigen::Vector3d(1.0, unknown, noise.coloured * noise.coloured).asDiagonal();
  std::vector<ObserverGains> gains(recording.samples());
  std::optional<Propagation> ahead;
  Eigen::Matrix3d P = at_start;
  double length = 0.0;   // of the last step [s]
  bool settled = false;  // the gains no longer change
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  for (std::size_t k = 1; k < gains.size(); ++k) {
    if (std::binary_search(recording.restarts.begin(), recording.restarts.end(), k)) {
      P = at_start;
      settled = false;
      continue;
    }
    const double step = recording.time(k) - recording.time(k - 1);
    const bool is_like_last = std::abs(step - length) <= alike * length;
    const bool is_read = recording.valid.empty() || recording.valid[k];
    if (!is_like_last) ahead.emplace(noise, step / recording.period, std::exp(-step / rules::colouring_time));
    length = step;
    if (settled && is_like_last && is_read) {
      gains[k] = gains[k - 1];
      continue;
    }
    P = ahead->ahead(P);
    Eigen::Vector3d K = Eigen::Vector3d::Zero();
    if (is_read) K = P.col(0) / (P(0, 0) + 1.0 / prepared.share(k));
    P -= K * P.row(0).eval();
    gains[k] = {K[0], K[1], K[2], ahead->F(2, 2)};
    settled = prepared.shares.empty() && is_like_last && is_read && (K - last).norm() <= still * K.norm();
    last = K;
  }
  return gains;
}

}  // namespace wormdrive
