#include "sweep/summary/elementary_effects.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "statistics/moments.hpp"
#include "statistics/student_t.hpp"
#include "sweep/summary/blocks.hpp"

namespace wormdrive {

MorrisScreening elementary_effects(const Column& values, const DesignSettings& settings, std::size_t parameters,
                                   std::uint64_t seed) {
  MorrisScreening screening;
  Design design(settings, parameters, seed);
  std::vector<Moments> effects(parameters), sizes(parameters);
  for_each_block(values, parameters + 1, [&](std::uint64_t number, const std::vector<double>& trajectory) {
    if (!is_whole(trajectory)) {
      ++screening.left_out;
      return;
    }
    ++screening.used;
    const std::uint64_t first = number * (parameters + 1);
    std::vector<double> before = design.point(first);
    for (std::size_t step = 1; step <= parameters; ++step) {
      const std::vector<double> after = design.point(first + step);
      const auto changed =
          static_cast<std::size_t>(std::mismatch(after.begin(), after.end(), before.begin()).first - after.begin());
      const double effect = (trajectory[step] - trajectory[step - 1]) / (after[changed] - before[changed]);
      effects[changed].add(effect);
      sizes[changed].add(std::abs(effect));
      before = after;
    }
  });
  if (screening.used < 2) return screening;
  const auto used = static_cast<double>(screening.used);
  const double widths = t_quantile(screening.used - 1) / std::sqrt(used);
  for (std::size_t k = 0; k < parameters; ++k) {
    const double mean = sizes[k].mean, half = widths * sizes[k].deviation();
    screening.of.push_back({effects[k].mean, {mean, mean - half, mean + half}, effects[k].deviation()});
  }
  return screening;
}

}  // namespace wormdrive
