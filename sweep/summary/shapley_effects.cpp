#include "sweep/summary/shapley_effects.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "statistics/student_t.hpp"
#include "sweep/summary/blocks.hpp"

namespace wormdrive {
namespace {

/// Sums over permutations of a part of the variance, x, and of the variance itself, v.
struct ShareSums {
  std::uint64_t count = 0;
  double x = 0.0, xx = 0.0, xv = 0.0, v = 0.0, vv = 0.0;

  void add(double part, double variance) {
    ++count;
    x += part;
    xx += part * part;
    xv += part * variance;
    v += variance;
    vv += variance * variance;
  }
  /// Nothing where fewer than two permutations, or none in which the metric changes, tell of it.
  std::optional<SampleEstimate> share() const {
    if (count < 2 || v == 0.0) return std::nullopt;
    const auto used = static_cast<double>(count);
    const double mean = x / v;
    // a ratio of means varies as the mean of x - share v does, whose own mean is 0
    const double squares = std::max(0.0, xx - 2.0 * mean * xv + mean * mean * vv);
    const double half = t_quantile(count - 1) * std::sqrt(used / (used - 1.0) * squares) / v;
    return SampleEstimate{mean, mean - half, mean + half};
  }
  /// The same of a part that is never negative: few large ones make most of it, and its logarithm is nearer to normal.
  std::optional<SampleEstimate> positive_share() const {
    std::optional<SampleEstimate> estimate = share();
    if (!estimate || x == 0.0) return estimate;
    const double mean = estimate->value, factor = std::exp(estimate->high / mean - 1.0);
    return SampleEstimate{mean, mean / factor, std::max(mean, std::min(1.0, mean * factor))};
  }
};
/// Of one parameter: where it stands anywhere, first, and last.
struct ParameterSums {
  ShareSums all, first, last;
};

}  // namespace

ShapleyEffects shapley_effects(const Column& values, const DesignSettings& settings, std::size_t parameters,
                               std::uint64_t seed) {
  ShapleyEffects effects;
  const Design design(settings, parameters, seed);
  std::vector<ParameterSums> sums(parameters);
  // f: the first draw, and with all parameters from each place of the order on drawn anew
  for_each_block(values, parameters + 1, [&](std::uint64_t permutation, const std::vector<double>& f) {
    if (!is_whole(f)) {
      ++effects.left_out;
      return;
    }
    ++effects.used;
    // half the square is the variance that those have from a place on, given the others, in the mean
    const auto variance_from = [&](std::size_t place) {
      const double change = place < parameters ? f[place + 1] - f[0] : 0.0;
      return 0.5 * change * change;
    };
    const double variance = variance_from(0);
    const std::vector<std::size_t> order = design.order(permutation);
    for (std::size_t place = 0; place < parameters; ++place) {
      const double adds = variance_from(place) - variance_from(place + 1);
      ParameterSums& of = sums[order[place]];
      of.all.add(adds, variance);
      if (place == 0) of.first.add(adds, variance);
      if (place + 1 == parameters) of.last.add(adds, variance);
    }
  });
  for (const ParameterSums& of : sums)
    if (const auto share = of.all.share()) effects.of.push_back({*share, of.first.share(), of.last.positive_share()});
  return effects;
}

}  // namespace wormdrive
