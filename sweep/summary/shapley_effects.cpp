#include "sweep/summary/shapley_effects.hpp"

#include <algorithm>
#include <cmath>

#include "statistics/student_t.hpp"
#include "sweep/summary/blocks.hpp"

namespace wormdrive {
namespace {

/// Sums over the permutations of what a parameter adds to the variance, x, and of the variance itself, v.
struct ShareSums {
  double x = 0.0, xx = 0.0, xv = 0.0;

  void add(double adds, double variance) {
    x += adds;
    xx += adds * adds;
    xv += adds * variance;
  }
};

}  // namespace

ShapleyEffects shapley_effects(const Column& values, const DesignSettings& settings, std::size_t parameters,
                               std::uint64_t seed) {
  ShapleyEffects effects;
  const Design design(settings, parameters, seed);
  std::vector<ShareSums> sums(parameters);
  double v = 0.0, vv = 0.0;
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
    v += variance;
    vv += variance * variance;
    const std::vector<std::size_t> order = design.order(permutation);
    for (std::size_t place = 0; place < parameters; ++place)
      sums[order[place]].add(variance_from(place) - variance_from(place + 1), variance);
  });
  if (effects.used < 2 || v == 0.0) return effects;
  const auto used = static_cast<double>(effects.used);
  const double widths = t_quantile(effects.used - 1);
  for (const ShareSums& s : sums) {
    const double share = s.x / v;
    // a ratio of means varies as the mean of x - share v does, whose own mean is 0
    const double squares = std::max(0.0, s.xx - 2.0 * share * s.xv + share * share * vv);
    const double half = widths * std::sqrt(used / (used - 1.0) * squares) / v;
    effects.of.push_back({share, share - half, share + half});
  }
  return effects;
}

}  // namespace wormdrive
