#include "diagnosis/fitting/noise_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "diagnosis/predictor/observer_gains.hpp"

namespace wormdrive {

namespace {

/// Noise of one recording, and of how many samples it is known.
struct RecordedNoise {
  NoiseSizes sizes{};
  double samples = 0.0;
};

RecordedNoise recorded_noise(const Evaluation& evaluation, const Hypothesis& h, std::size_t recording) {
  const PreparedRecording& r = evaluation.layout().recordings[recording];
  const std::span<const double> e =
      evaluation.layout().of(evaluation.layout().leading(recording), std::span(h.innovations));
  const std::vector<ObserverGains> gains = observer_gains(h.noise, r);
  std::vector<double> sizes;
  double variances = 0.0;  // of the predicted angles, over that of a reading
  for (std::size_t k = 0; k < r.samples(); ++k) {
    if (!r.used[k] || !r.moving[k]) continue;
    sizes.push_back(std::abs(e[k]));
    const double K = gains_at(gains, k).angle;  // = P/(P + 1/share)
    variances += K / ((1.0 - K) * r.share(k));
  }
  if (sizes.empty()) return {};
  std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2), sizes.end());
  constexpr double normal_median = 0.6745;
  const double innovation = sizes[sizes.size() / 2] / normal_median;
  RecordedNoise noise{{}, static_cast<double>(sizes.size())};
  noise.sizes.angle = innovation / std::sqrt(1.0 + variances / noise.samples);
  const ProcessNoise process = h.noise.over(r.data.period);
  noise.sizes.torque = std::hypot(process.white, process.coloured) * noise.sizes.angle *
                       inertia_on_worm(evaluation, h, recording) / (r.data.period * r.data.period);
  return noise;
}

}  // namespace

NoiseSizes noise_sizes(const Evaluation& evaluation, const Hypothesis& h) {
  double samples = 0.0, angles = 0.0, torques = 0.0;
  for (std::size_t r = 0; r < evaluation.layout().recordings.size(); ++r) {
    const RecordedNoise one = recorded_noise(evaluation, h, r);
    samples += one.samples;
    angles += one.samples * one.sizes.angle * one.sizes.angle;
    torques += one.samples * one.sizes.torque * one.sizes.torque;
  }
  if (samples == 0.0) return {};
  return {std::sqrt(angles / samples), std::sqrt(torques / samples)};
}

}  // namespace wormdrive
