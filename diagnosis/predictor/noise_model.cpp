#include "diagnosis/predictor/noise_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include <Eigen/Cholesky>

#include "diagnosis/predictor/noise_tails.hpp"

namespace wormdrive {

namespace {

constexpr std::size_t terms = rules::whitening_times.size();
using Vector = Eigen::Matrix<double, terms, 1>;
using Matrix = Eigen::Matrix<double, terms, terms>;

/// Runs the exponential means through a recording: visit(sample, means before it).
class Means {
 public:
  explicit Means(double period) {
    for (std::size_t j = 0; j < terms; ++j)
      keep_[j] = rules::whitening_times[j] > 0.0 ? std::exp(-period / rules::whitening_times[j]) : 0.0;
  }
  const std::array<double, terms>& values() const { return z_; }
  void add(double e) {
    for (std::size_t j = 0; j < terms; ++j) z_[j] = keep_[j] * (z_[j] - e) + e;
  }

 private:
  std::array<double, terms> keep_{}, z_{};
};

double predicted(const WhiteningWeights& weights, const double* z) {
  double sum = 0.0;
  for (std::size_t j = 0; j < terms; ++j) sum += weights[j] * z[j];
  return sum;
}

/// The smallest scale that a group may have: a sensor of finite resolution has the noise of rounding at least.
double least_scale(const PreparedRecording& recording, double resolution, bool moving) {
  return std::max(1e-9 * std::max(1e-3, recording.rms_speed),
                  (moving ? rules::rounding_moving : rules::rounding_at_rest) * resolution);
}

/// Median of magnitudes as a scale of Student's t.
double robust_scale(std::vector<double>& sizes) {
  if (sizes.empty()) return 0.0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle / 0.741;
}

/// Estimates the noise of one channel: of its standing and of its moving samples. It walks the samples again and again,
/// for to keep what a walk needs of each takes more time and memory than to work it out anew.
class NoiseOfChannel {
 public:
  NoiseOfChannel(const InnovationLayout& layout, const Channel& channel, std::span<const double> innovations,
                 bool whitens)
      : layout_(layout),
        channel_(channel),
        recording_(layout.recordings[channel.recording]),
        e_(layout.of(channel, innovations)),
        whitens_(whitens) {
    for_each_fitted([&](std::size_t, std::size_t g) { ++members_[g]; });
  }

  /// groups: of standing and of moving samples.
  void fit(std::span<NoiseGroup> groups) const {
    fit_first_scales(groups);
    for (const int iterations : {3, 6}) {  // the scales of the first round only serve the weights of the second
      const bool is_last = iterations == 6;
      const auto takes_part = [&](std::size_t g) { return members_[g] > 0 && (is_last || is_whitened(g)); };
      if (!takes_part(0) && !takes_part(1)) continue;
      if (is_whitened(0) || is_whitened(1)) whiten(groups);
      const std::array<std::vector<Square>, 2> left = squares_left(groups);
      for (const std::size_t g : {0, 1})
        if (takes_part(g)) fit_scale_and_tails(groups[g], left[g], least(g), channel_.resolution, iterations);
    }
  }

 private:
  /// visit(sample, group)
  template <class Visit>
  void for_each_fitted(Visit&& visit) const {
    for (std::size_t k = 0; k < e_.size(); ++k)
      if (layout_.part[channel_.begin + k] == 1) visit(k, layout_.group[channel_.begin + k] & 1U);
  }
  /// visit(sample, group, means before it)
  template <class Visit>
  void for_each_with_means(Visit&& visit) const {
    Means z(recording_.data.period);
    for (std::size_t k = 0; k < e_.size(); ++k) {
      if (layout_.part[channel_.begin + k] == 1) visit(k, layout_.group[channel_.begin + k] & 1U, z.values().data());
      if (whitens_) z.add(e_[k]);
    }
  }
  bool is_whitened(std::size_t g) const { return whitens_ && members_[g] >= rules::fewest_for_weights; }
  double least(std::size_t g) const { return least_scale(recording_, channel_.resolution, g == 1); }
  double share(std::size_t k) const { return layout_.share[channel_.begin + k]; }

  /// By the median of every fifth sample.
  void fit_first_scales(std::span<NoiseGroup> groups) const {
    std::array<std::vector<double>, 2> sizes;
    std::array<std::size_t, 2> seen{};
    for_each_fitted([&](std::size_t k, std::size_t g) {
      if (seen[g]++ % 5 == 0) sizes[g].push_back(std::abs(e_[k]));
    });
    for (const std::size_t g : {0, 1})
      groups[g].scale = std::max(least(g), sizes[g].size() > rules::fewest_for_scale ? robust_scale(sizes[g]) : 0.0);
  }

  void whiten(std::span<NoiseGroup> groups) const {
    std::array<Matrix, 2> A{Matrix::Zero(), Matrix::Zero()};
    std::array<Vector, 2> b{Vector::Zero(), Vector::Zero()};
    const auto inverse_square = [](const NoiseGroup& group) { return 1.0 / (group.scale * group.scale); };
    const std::array inverse{inverse_square(groups[0]), inverse_square(groups[1])};
    for_each_with_means([&](std::size_t k, std::size_t g, const double* means) {
      const Eigen::Map<const Vector> z(means);
      const double x = e_[k] - predicted(groups[g].weights, means), nu = groups[g].freedom;
      const double weight = share(k) * (nu + 1.0) / (nu + x * x * inverse[g]);
      b[g] += weight * e_[k] * z;
      A[g] += (weight * z) * z.transpose();
    });
    for (const std::size_t g : {0, 1}) {
      if (!is_whitened(g)) continue;
      A[g].diagonal().array() += 1e-6 * A[g].trace() / terms + 1e-300;
      Vector::Map(groups[g].weights.data()) = A[g].ldlt().solve(b[g]);
    }
  }

  /// Of the innovations less what those before predict of them.
  std::array<std::vector<Square>, 2> squares_left(std::span<const NoiseGroup> groups) const {
    std::array<std::vector<Square>, 2> left;
    for (const std::size_t g : {0, 1}) left[g].reserve(members_[g]);
    for_each_with_means([&](std::size_t k, std::size_t g, const double* means) {
      const double x = e_[k] - predicted(groups[g].weights, means);
      left[g].push_back({x * x, share(k)});
    });
    return left;
  }

  const InnovationLayout& layout_;
  const Channel& channel_;
  const PreparedRecording& recording_;
  std::span<const double> e_;
  bool whitens_;
  std::array<std::size_t, 2> members_{};  ///< samples that are fitted
};

}  // namespace

NoiseModel estimate_noise(const InnovationLayout& layout, std::span<const double> innovations, bool whitens) {
  NoiseModel noise{std::vector<NoiseGroup>(layout.groups()), whitens};
  for (std::size_t c = 0; c < layout.channels.size(); ++c)
    NoiseOfChannel(layout, layout.channels[c], innovations, whitens).fit(std::span(noise.groups).subspan(2 * c, 2));
  return noise;
}

bool hides_what_is_slow(const NoiseModel& noise) {
  for (std::size_t g = 1; g < noise.groups.size(); g += 2) {
    const WhiteningWeights& weights = noise.groups[g].weights;
    if (std::accumulate(weights.begin(), weights.end(), 0.0) >= rules::hides_what_is_slow) return true;
  }
  return false;
}

std::vector<double> whitened(const InnovationLayout& layout, std::span<const double> innovations,
                             const NoiseModel& noise) {
  std::vector<double> w(innovations.begin(), innovations.end());
  if (!noise.whitens) return w;
  for (const Channel& channel : layout.channels) {
    const PreparedRecording& recording = layout.recordings[channel.recording];
    Means z(recording.data.period);
    const std::size_t begin = channel.begin, end = begin + recording.samples();
    for (std::size_t k = begin; k < end; ++k) {
      w[k] -= predicted(noise.groups[layout.group[k]].weights, z.values().data());
      z.add(innovations[k]);
    }
  }
  return w;
}

std::vector<double> drawn_innovations(const InnovationLayout& layout, std::span<const double> whitened,
                                      const NoiseModel& noise, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::vector<double>> pools(layout.groups());
  for (std::size_t k = 0; k < layout.size; ++k)
    if (layout.part[k] != 0) pools[layout.group[k]].push_back(whitened[k]);
  std::vector<double> e(layout.size, 0.0);
  for (const Channel& channel : layout.channels) {
    const PreparedRecording& recording = layout.recordings[channel.recording];
    Means z(recording.data.period);
    const std::size_t begin = channel.begin, end = begin + recording.samples();
    double told = 1.0, last = 0.0;  // errors of readings that count as one are alike
    for (std::size_t k = begin; k < end; ++k) {
      const std::vector<double>& pool = pools[layout.group[k]];
      const bool is_read = recording.data.valid.empty() || recording.data.valid[k - begin] != 0;
      if (pool.empty() || !is_read) {
        z.add(0.0);
        continue;
      }
      told += layout.share[k];
      if (noise.whitens || told >= 1.0) {
        const std::uint64_t draw = random();  // its lowest bit is the sign
        last = (draw & 1U ? 1.0 : -1.0) * pool[(draw >> 1U) % pool.size()];
        told -= 1.0;
      }
      e[k] = last;
      // weights that keep most of what is steady tell of slow structure, and would let noise grow
      const WhiteningWeights& weights = noise.groups[layout.group[k]].weights;
      if (noise.whitens && std::accumulate(weights.begin(), weights.end(), 0.0) < rules::hides_what_is_slow)
        e[k] += predicted(weights, z.values().data());
      z.add(e[k]);
    }
  }
  return e;
}

Misfit misfit(const InnovationLayout& layout, std::span<const double> w, const NoiseModel& noise) {
  Misfit sum;
  sum.blocks.assign(layout.blocks, 0.0);
  const std::vector<NegativeLogLikelihood> negative_log_likelihood(noise.groups.begin(), noise.groups.end());
  for (std::size_t k = 0; k < layout.size; ++k) {
    if (layout.part[k] == 0) continue;
    sum.blocks[layout.block[k]] += layout.share[k] * negative_log_likelihood[layout.group[k]](w[k] * w[k]);
  }
  std::vector<std::uint8_t> out(layout.blocks, 0);
  for (std::size_t k = 0; k < layout.size; ++k)
    if (layout.part[k] == 2) out[layout.block[k]] = 1;
  for (std::size_t b = 0; b < layout.blocks; ++b) (out[b] ? sum.held_out : sum.fitted) += sum.blocks[b];
  return sum;
}

std::vector<double> fit_weights(const InnovationLayout& layout, std::span<const double> w, const NoiseModel& noise) {
  std::vector<double> weight(layout.size, 0.0);
  for (std::size_t k = 0; k < layout.size; ++k) {
    if (layout.part[k] != 1) continue;
    const NoiseGroup& group = noise.groups[layout.group[k]];
    const double nu = group.freedom, s2 = group.scale * group.scale;
    weight[k] = layout.share[k] * (nu + 1.0) / ((nu + w[k] * w[k] / s2) * s2);
  }
  return weight;
}

}  // namespace wormdrive
