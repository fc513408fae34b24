#include "diagnosis/predictor/observer_gains.hpp"

#include <cmath>

#include <Eigen/Core>

namespace wormdrive {

namespace {

/// Without a coloured torque the gains have a closed form [Kalata 1984, the tracking index of an alpha-beta filter].
ObserverGains alpha_beta(double index, double keep) {
  const double r = (4.0 + index - std::sqrt(8.0 * index + index * index)) / 4.0;
  const double alpha = 1.0 - r * r;
  return {alpha, 2.0 * (2.0 - alpha) - 4.0 * std::sqrt(1.0 - alpha), 0.0, keep};
}

}  // namespace

ObserverGains observer_gains(const ProcessNoise& noise, double period) {
  const double a = std::exp(-period / colouring_time);
  if (noise.coloured <= 0.0) return alpha_beta(noise.white, a);
  using Matrix = Eigen::Matrix3d;
  Matrix F;
  F << 1.0, 1.0, 0.5, 0.0, 1.0, 1.0, 0.0, 0.0, a;
  const double white = noise.white * noise.white, coloured = noise.coloured * noise.coloured;
  Matrix Q = Matrix::Zero();
  Q.topLeftCorner<2, 2>() << 0.25 * white, 0.5 * white, 0.5 * white, white;
  Q(2, 2) = coloured * (1.0 - a * a);
  Matrix P = Eigen::Vector3d(1.0, 0.1, coloured).asDiagonal();
  Eigen::Vector3d K = Eigen::Vector3d::Zero(), before = K;
  constexpr int most = 4000, look_every = 20;
  for (int k = 1; k <= most; ++k) {
    const Matrix ahead = F * P * F.transpose() + Q;
    K = ahead.col(0) / (ahead(0, 0) + 1.0);
    P = ahead - K * ahead.row(0);
    if (k % look_every != 0) continue;
    if ((K - before).cwiseAbs().maxCoeff() <= 1e-7 * K[0] || (K - before).isZero(1e-15)) break;
    before = K;
  }
  return {K[0], K[1], K[2], a};
}

}  // namespace wormdrive
