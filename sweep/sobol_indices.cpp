#include <algorithm>
#include <cmath>

#include "sweep/random.hpp"
#include "sweep/statistics.hpp"

namespace wormdrive {
namespace {

/// Calls visit(j, values) for the j-th block that is whole; its values are those at A, at B, and at A with one
/// parameter after the other from B.
template <class Visit>
void for_each_block(const Column& column, std::size_t parameters, Visit&& visit) {
  std::vector<double> block;
  std::uint64_t whole = 0;
  column([&](std::span<const double> values) {
    for (const double value : values) {
      block.push_back(value);
      if (block.size() < parameters + 2) continue;
      if (std::all_of(block.begin(), block.end(), [](double v) { return std::isfinite(v); })) visit(whole++, block);
      block.clear();
    }
  });
}

/// What indices are worked out from.
struct BlockSums {
  explicit BlockSums(std::size_t parameters) : first(parameters), total(parameters) {}

  double weight = 0.0, sum = 0.0, squares = 0.0;
  std::vector<double> first, total;

  /// centred: values of a block less about their mean, so that the products lose no digits to it.
  void add(double times, const std::vector<double>& centred) {
    const double a = centred[0], b = centred[1];
    weight += times;
    sum += times * (a + b);
    squares += times * (a * a + b * b);
    for (std::size_t k = 0; k < first.size(); ++k) {
      const double change = centred[k + 2] - a;
      first[k] += times * b * change;
      total[k] += times * 0.5 * change * change;
    }
  }
  double variance() const {
    const double mean = sum / (2.0 * weight);
    return squares / (2.0 * weight) - mean * mean;
  }
  double first_index(std::size_t k) const { return first[k] / (weight * variance()); }
  double total_index(std::size_t k) const { return total[k] / (weight * variance()); }
};

constexpr std::size_t resamples = 200;

/// How often a block stands in a resample: Poisson with mean 1, by inversion of a number from (0, 1).
double times_taken(double u) {
  double probability = std::exp(-1.0), sum = probability, k = 0.0;
  while (u > sum && probability > 0.0) {
    probability /= ++k;
    sum += probability;
  }
  return k;
}

/// The middle 95 % of resampled values around an estimate.
SampleEstimate interval(double value, std::vector<double>& resampled) {
  std::sort(resampled.begin(), resampled.end());
  const std::size_t beyond = resampled.size() / 40;
  return {value, resampled[beyond], resampled[resampled.size() - 1 - beyond]};
}

double deviation(const std::vector<double>& values) {
  double mean = 0.0, squares = 0.0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  for (const double v : values) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

}  // namespace

std::vector<SobolIndex> sobol_indices(const Column& values, std::size_t parameters, std::uint64_t seed) {
  std::uint64_t blocks = 0;
  double centre = 0.0, some = 0.0;
  bool constant = true;
  for_each_block(values, parameters, [&](std::uint64_t j, const std::vector<double>& f) {
    if (j == 0) some = f[0];
    constant = constant && f[0] == some && f[1] == some;
    centre += (0.5 * (f[0] + f[1]) - centre) / static_cast<double>(++blocks);
  });
  if (blocks < 2 || constant) return {};

  BlockSums best(parameters);
  std::vector<BlockSums> again(resamples, best);
  for_each_block(values, parameters, [&](std::uint64_t j, std::vector<double>& f) {
    for (double& value : f) value -= centre;
    best.add(1.0, f);
    for (std::size_t r = 0; r < resamples; r += 4) {
      const auto bits = random_bits(seed, SweepStream::bootstrap, j, r);
      for (std::size_t k = 0; k < bits.size(); ++k)
        if (const double times = times_taken(to_unit_interval(bits[k])); times > 0.0) again[r + k].add(times, f);
    }
  });
  std::erase_if(again, [](const BlockSums& sums) { return !(sums.variance() > 0.0); });
  if (again.size() < 2) return {};

  std::vector<SobolIndex> indices;
  for (std::size_t k = 0; k < parameters; ++k) {
    std::vector<double> first, total;
    for (const BlockSums& sums : again) {
      first.push_back(sums.first_index(k));
      total.push_back(sums.total_index(k));
    }
    const double first_deviation = deviation(first), total_deviation = deviation(total);
    indices.push_back(
        {interval(best.first_index(k), first), interval(best.total_index(k), total), first_deviation, total_deviation});
  }
  return indices;
}

}  // namespace wormdrive
