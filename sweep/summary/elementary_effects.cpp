#include "sweep/summary/elementary_effects.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/math/distributions/students_t.hpp>

namespace wormdrive {
namespace {

/// Mean and squares of distances from it, of numbers added one after the other [Welford1962].
struct RunningMoments {
  double count = 0.0, mean = 0.0, squares = 0.0;

  void add(double value) {
    const double distance = value - mean;
    mean += distance / ++count;
    squares += distance * (value - mean);
  }
  double deviation() const { return std::sqrt(squares / (count - 1.0)); }
};

}  // namespace

MorrisScreening elementary_effects(const Column& values, const DesignSettings& settings, std::size_t parameters,
                                   std::uint64_t seed) {
  MorrisScreening screening;
  Design design(settings, parameters, seed);
  std::vector<RunningMoments> effects(parameters), sizes(parameters);
  std::vector<double> trajectory;
  std::uint64_t first = 0;
  const auto add = [&] {
    if (!std::all_of(trajectory.begin(), trajectory.end(), [](double v) { return std::isfinite(v); })) {
      ++screening.left_out;
      return;
    }
    ++screening.used;
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
  };
  values([&](std::span<const double> part) {
    for (const double value : part) {
      trajectory.push_back(value);
      if (trajectory.size() <= parameters) continue;
      add();
      first += parameters + 1;
      trajectory.clear();
    }
  });
  if (screening.used < 2) return screening;
  const auto used = static_cast<double>(screening.used);
  const double widths = quantile(boost::math::students_t(used - 1.0), 0.975) / std::sqrt(used);
  for (std::size_t k = 0; k < parameters; ++k) {
    const double mean = sizes[k].mean, half = widths * sizes[k].deviation();
    screening.of.push_back({effects[k].mean, {mean, mean - half, mean + half}, effects[k].deviation()});
  }
  return screening;
}

}  // namespace wormdrive
