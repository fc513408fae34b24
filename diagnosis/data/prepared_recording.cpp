#include "diagnosis/data/prepared_recording.hpp"

#include <algorithm>
#include <cmath>

namespace wormdrive {

namespace {

double root_mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double x : values) sum += x * x;
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

/// Slope of the least-squares line through half_width samples on either side, whose steps are even among themselves.
std::vector<double> slopes(const std::vector<double>& y, const Recording& recording, long half_width) {
  const long n = static_cast<long>(y.size());
  const long w = std::min(half_width, (n - 1) / 2);
  std::vector<double> slope(y.size(), 0.0);
  double squares = 0.0;
  for (long j = -w; j <= w; ++j) squares += static_cast<double>(j * j);
  if (squares == 0.0) return slope;
  for (long k = 0; k < n; ++k) {
    const long middle = std::clamp(k, w, n - 1 - w);
    double sum = 0.0;
    const double here = y[static_cast<std::size_t>(middle)];  // what stands has no slope, not one of rounding
    for (long j = -w; j <= w; ++j) sum += static_cast<double>(j) * (y[static_cast<std::size_t>(middle + j)] - here);
    const auto first = static_cast<std::size_t>(middle - w), last = static_cast<std::size_t>(middle + w);
    const double step = recording.times.empty()
                            ? recording.period
                            : (recording.times[last] - recording.times[first]) / static_cast<double>(2 * w);
    slope[static_cast<std::size_t>(k)] = sum / (squares * step);
  }
  return slope;
}

/// Where the worm's zero is nobody states: it is put where both encoders agree on average.
std::vector<double> worm_at_gear(const Recording& recording, double ratio) {
  std::vector<double> angle;
  double apart = 0.0;
  for (std::size_t k = 0; k < recording.worm_angle.size(); ++k) {
    angle.push_back(recording.worm_angle[k] / ratio);
    apart += (angle.back() - recording.gear_angle[k]) / static_cast<double>(recording.worm_angle.size());
  }
  for (double& x : angle) x -= apart;
  return angle;
}

}  // namespace

PreparedRecording prepared(const Recording& recording, const CuttingRules& rules, std::size_t first_block,
                           double ratio) {
  PreparedRecording p;
  p.data = recording;
  const std::size_t n = recording.samples();
  const double Ts = recording.period;
  p.worm_angle = worm_at_gear(recording, ratio);
  p.worm_resolution = recording.worm_resolution / ratio;
  p.speed = slopes(recording.gear_angle, recording, std::max(4L, std::lround(rules.slope_half_width / Ts)));
  p.rms_speed = root_mean_square(p.speed);
  p.rms_torque = root_mean_square(recording.motor_torque);
  for (const double u : recording.motor_torque) p.largest_torque = std::max(p.largest_torque, std::abs(u));
  p.block_length = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(rules.block / Ts)));
  p.moving.resize(n);
  p.used.resize(n);
  p.held_out.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    p.moving[k] = std::abs(p.speed[k]) > rules.standing_share * p.rms_speed;
    p.used[k] = static_cast<double>(k) * Ts >= rules.burn_in && (recording.valid.empty() || recording.valid[k]);
    const std::size_t block = first_block + k / p.block_length;
    p.held_out[k] =
        block % static_cast<std::size_t>(rules.held_out_every) == static_cast<std::size_t>(rules.held_out_every) - 1;
  }
  return p;
}

PreparedRecording with_all_data(PreparedRecording recording) {
  std::fill(recording.held_out.begin(), recording.held_out.end(), std::uint8_t{0});
  return recording;
}

}  // namespace wormdrive
