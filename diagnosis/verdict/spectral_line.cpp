#include "diagnosis/verdict/spectral_line.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

#include <fmt/format.h>
#include <unsupported/Eigen/FFT>

#include "diagnosis/fitting/prediction_error.hpp"
#include "diagnosis/rules/noise.hpp"
#include "diagnosis/rules/verdict.hpp"

namespace wormdrive {

ScoreTest spectral_line(const Evaluation& evaluation, const Hypothesis& h, std::size_t recording,
                        const std::vector<double>* factor, std::string name) {
  const InnovationLayout& layout = evaluation.layout();
  const PreparedRecording& r = layout.recordings[recording];
  const std::size_t begin = layout.leading(recording).begin;
  const auto bin = static_cast<std::size_t>(std::max(1L, std::lround(rules::spectrum_bin / r.data.period)));
  const std::size_t n = r.samples() / bin;
  std::vector<double> w(n, 0.0);
  for (std::size_t k = 0; k < n * bin; ++k) {
    if (!r.used[k] || !r.moving[k]) continue;
    const NoiseGroup& group = h.noise_model.groups[layout.group[begin + k]];
    const double z = h.residuals[begin + k] / group.scale;
    w[k / bin] += z / (1.0 + z * z / group.freedom) * (factor ? (*factor)[layout.begins[recording] + k] : 1.0);
  }
  Eigen::FFT<double> transform;
  std::vector<std::complex<double>> spectrum;
  transform.fwd(spectrum, w);
  const std::size_t lines = std::min(n / 2, static_cast<std::size_t>(rules::highest_line * r.duration()));
  std::vector<double> power(lines);
  std::transform(spectrum.begin(), spectrum.begin() + static_cast<std::ptrdiff_t>(lines), power.begin(),
                 [](std::complex<double> x) { return std::norm(x); });
  ScoreTest test;
  constexpr std::size_t around = rules::lines_around;
  // the median of m exponential variates is known as well as the mean of 0.48 m of them
  constexpr double variates = 0.48 * (2 * around + 1);
  double strongest = 0.0, frequency = 0.0;
  std::size_t at = 0;
  for (auto f = std::max<std::size_t>(3, static_cast<std::size_t>(rules::lowest_line * r.duration())); f < lines; ++f) {
    std::vector<double> near(power.begin() + static_cast<std::ptrdiff_t>(f > around ? f - around : 1),
                             power.begin() + static_cast<std::ptrdiff_t>(std::min(lines, f + around + 1)));
    const auto middle = near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2);
    std::nth_element(near.begin(), middle, near.end());
    const double ratio = power[f] / (*middle / std::numbers::ln2 + 1e-300);
    if (ratio > strongest) {
      strongest = ratio;
      at = f;
      frequency = static_cast<double>(f) / (static_cast<double>(n * bin) * r.data.period);
    }
  }
  test.what.gain = strongest;
  // A torque of this frequency adds up over a part of its period, noise over the whole horizon.
  const double others = std::accumulate(power.begin(), power.end(), 0.0) - power[at];
  const double white = others * 0.5 * static_cast<double>(n) / static_cast<double>(lines);  // up to half the rate
  const double line = power[at] / std::max(white, std::numeric_limits<double>::min());
  const double interval = static_cast<double>(bin) * r.data.period, turn = 2.0 * std::numbers::pi * frequency;
  const double adds_up =
      std::min(2.0 / (turn * turn * interval * rules::reported_horizon), rules::reported_horizon / interval);
  test.ahead = line * adds_up;
  test.what.frequency = factor ? 0.0 : frequency;
  test.what.axis = fmt::format("{} at {:.5} Hz", name, fmt::format("{:f}", frequency));
  test.what.evidence =
      variates * std::log1p(strongest / variates) - std::log(static_cast<double>(std::max<std::size_t>(1, lines)));
  return test;
}

Hypothesis followed_slowly(const Evaluation& evaluation, Hypothesis h) {
  h.whitens = false;
  h.noise.coloured = 0.0;
  h.noise.period = evaluation.shortest_period();
  h.noise.white = std::pow(2.0 * std::numbers::pi * rules::lowest_line * h.noise.period, 2);  // its bandwidth, squared
  return h;
}

std::vector<ScoreTest> spectral_lines(const Evaluation& evaluation, const Hypothesis& h) {
  std::vector<ScoreTest> lines;
  Hypothesis slow = followed_slowly(evaluation, h);
  const bool follows = evaluate(evaluation, slow);
  for (std::size_t r = 0; r < evaluation.layout().recordings.size(); ++r) {
    lines.push_back(spectral_line(evaluation, h, r, nullptr, "a line"));
    if (!follows) continue;
    ScoreTest other = spectral_line(evaluation, slow, r, nullptr, "a line");
    if (other.what.evidence > lines.back().what.evidence) lines.back() = std::move(other);
  }
  return lines;
}

}  // namespace wormdrive
