#include "diagnosis/data/prepared_recording.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/data/needed_torque.hpp"
#include "diagnosis/rules/recordings.hpp"

namespace wormdrive {

namespace {

double root_mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double x : values) sum += x * x;
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

/// Slopes of the least-squares lines through half_width samples on either side, within a stretch of a recording.
void find_slopes(const Recording& recording, std::size_t begin, std::size_t end, std::size_t half_width,
                 std::vector<double>& slope) {
  const std::vector<double>& y = recording.gear_angle;
  const std::size_t w = std::min(half_width, (end - begin - 1) / 2);
  if (w == 0) return;
  for (std::size_t k = begin; k < end; ++k) {
    const std::size_t middle = std::clamp(k, begin + w, end - 1 - w);
    double sum = 0.0, squares = 0.0, steps = 0.0, way = 0.0;
    for (std::size_t j = middle - w; j <= middle + w; ++j) {
      // from the middle's own angle and time: what stands has no slope, not one of rounding
      const double step = recording.times.empty() ? static_cast<double>(j) - static_cast<double>(middle)
                                                  : (recording.times[j] - recording.times[middle]) / recording.period;
      sum += step * (y[j] - y[middle]);
      squares += step * step;
      steps += step;
      way += y[j] - y[middle];
    }
    const double share = steps / static_cast<double>(2 * w + 1);
    slope[k] = (sum - share * way) / ((squares - share * steps) * recording.period);
  }
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

/// Whether readings repeat the one before too often while the gear moves.
bool repeats_itself(const Recording& recording, const std::vector<std::uint8_t>& moving) {
  const std::vector<double>& y = recording.gear_angle;
  std::size_t repeated = 0, all = 0;
  for (std::size_t k = 1; k < y.size(); ++k) {
    if (!moving[k]) continue;
    ++all;
    if (std::abs(y[k] - y[k - 1]) < 0.5 * recording.gear_resolution) ++repeated;
  }
  return static_cast<double>(repeated) > rules::most_repeated * static_cast<double>(all);
}

/// What each reading counts, of a sensor whose steps are longer than the way between two readings. Rounding errors of
/// readings that are closer than a step are alike: they would pass for something that the model can follow. Together
/// they count as one. None of them can be left out, for a controller has seen it and its torque tells of it.
std::vector<double> shares_of_readings(const Recording& recording, const std::vector<double>& speed) {
  // at this speed as many readings repeat the one before as may
  const double whole = (1.0 - rules::most_repeated) * recording.gear_resolution / recording.period;
  const double least = std::min(1.0, recording.period / rules::longest_period);
  std::vector<double> shares(speed.size());
  std::transform(speed.begin(), speed.end(), shares.begin(),
                 [&](double v) { return std::clamp(std::abs(v) / whole, least, 1.0); });
  return shares;
}

}  // namespace

bool is_held_out(std::size_t block) { return block % rules::held_out_every == rules::held_out_every - 1; }

PreparedRecording prepared(Recording given, std::size_t first_block, double ratio) {
  PreparedRecording p;
  p.data = std::move(given);
  const Recording& recording = p.data;
  const std::size_t n = recording.samples();
  const double Ts = recording.period;
  p.worm_angle = worm_at_gear(recording, ratio);
  p.worm_resolution = recording.worm_resolution / ratio;
  const std::size_t half_width = slope_half_width(Ts);
  p.speed.resize(n);
  for (std::size_t k = 0, begin = 0; k <= recording.restarts.size(); ++k) {
    const std::size_t end = k < recording.restarts.size() ? recording.restarts[k] : n;
    find_slopes(recording, begin, end, half_width, p.speed);
    begin = end;
  }
  p.rms_speed = root_mean_square(p.speed);
  p.torque_spikes = torque_spikes(recording);
  p.rms_torque = root_mean_square(recording.motor_torque);
  for (const double u : recording.motor_torque) p.largest_torque = std::max(p.largest_torque, std::abs(u));
  p.block_length = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(rules::block / Ts)));
  p.moving.resize(n);
  p.used.resize(n);
  p.held_out.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    p.moving[k] = std::abs(p.speed[k]) > rules::standing_share * p.rms_speed;
  }
  if (!recording.has_worm_encoder() && repeats_itself(recording, p.moving))
    p.shares = shares_of_readings(recording, p.speed);
  for (std::size_t k = 0; k < n; ++k) {
    p.used[k] = static_cast<double>(k) * Ts >= rules::burn_in && (p.data.valid.empty() || p.data.valid[k]);
    p.held_out[k] = is_held_out(first_block + k / p.block_length);
  }
  // a prediction that starts anew has its speed from these samples, and is not to be judged by them before it is as
  // good as that of the first start
  const auto guessed = static_cast<std::size_t>(std::ceil(rules::burn_in / Ts));
  for (const std::size_t restart : recording.restarts)
    for (std::size_t k = restart; k < std::min(n, restart + std::max(2 * half_width + 1, guessed)); ++k) p.used[k] = 0;
  return p;
}

PreparedRecording with_all_data(PreparedRecording recording) {
  std::fill(recording.held_out.begin(), recording.held_out.end(), std::uint8_t{0});
  return recording;
}

}  // namespace wormdrive
