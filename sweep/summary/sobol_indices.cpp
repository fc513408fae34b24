#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/math/distributions/students_t.hpp>

#include "sweep/study/design.hpp"
#include "sweep/summary/statistics.hpp"

namespace wormdrive {
namespace {

/// Calls visit(sample, values) for every sample that is there; its values are those at A, at B, and at A with one
/// parameter after the other from B.
template <class Visit>
void for_each_sample(const Column& column, std::size_t parameters, Visit&& visit) {
  std::vector<double> values;
  std::uint64_t sample = 0;
  column([&](std::span<const double> part) {
    for (const double value : part) {
      values.push_back(value);
      if (values.size() < parameters + 2) continue;
      visit(sample++, values);
      values.clear();
    }
  });
}

bool is_whole(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

/// What indices are worked out from.
struct IndexSums {
  explicit IndexSums(std::size_t parameters) : first(parameters), total(parameters) {}

  double weight = 0.0, sum = 0.0, squares = 0.0;
  std::vector<double> first, total;

  /// centred: values of a sample less about their mean, so that the products lose no digits to it.
  void add(const std::vector<double>& centred) {
    const double a = centred[0], b = centred[1];
    weight += 1.0;
    sum += a + b;
    squares += a * a + b * b;
    for (std::size_t k = 0; k < first.size(); ++k) {
      const double change = centred[k + 2] - a;
      first[k] += b * change;
      total[k] += 0.5 * change * change;
    }
  }
  /// sign: +1 adds other sums, -1 takes them away.
  void add(const IndexSums& other, double sign) {
    weight += sign * other.weight;
    sum += sign * other.sum;
    squares += sign * other.squares;
    for (std::size_t k = 0; k < first.size(); ++k) {
      first[k] += sign * other.first[k];
      total[k] += sign * other.total[k];
    }
  }
  double variance() const {
    const double mean = sum / (2.0 * weight);
    return squares / (2.0 * weight) - mean * mean;
  }
  double first_index(std::size_t k) const { return first[k] / (weight * variance()); }
  double total_index(std::size_t k) const { return total[k] / (weight * variance()); }
};

/// Standard error of a value from what it is without one of the parts in turn; infinite where these have none.
double jackknife_error(const std::vector<double>& without) {
  const auto parts = static_cast<double>(without.size());
  double mean = 0.0, squares = 0.0;
  for (const double v : without) mean += v / parts;
  for (const double v : without) squares += (v - mean) * (v - mean);
  const double error = std::sqrt(squares * (parts - 1.0) / parts);
  return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

}  // namespace

SobolIndices sobol_indices(const Column& values, std::size_t parameters) {
  SobolIndices indices;
  double centre = 0.0, some = 0.0;
  bool constant = true;
  for_each_sample(values, parameters, [&](std::uint64_t, const std::vector<double>& f) {
    if (!is_whole(f)) {
      ++indices.left_out;
      return;
    }
    if (indices.used++ == 0) some = f[0];
    constant = constant && f[0] == some && f[1] == some;
    centre += (0.5 * (f[0] + f[1]) - centre) / static_cast<double>(indices.used);
  });
  if (constant) return indices;

  IndexSums all(parameters);
  std::vector<IndexSums> parts;
  for (std::size_t r = 0; r < Saltelli::replicates; ++r) parts.emplace_back(parameters);
  for_each_sample(values, parameters, [&](std::uint64_t sample, std::vector<double>& f) {
    if (!is_whole(f)) return;
    for (double& value : f) value -= centre;
    parts[sample % Saltelli::replicates].add(f);
  });
  std::erase_if(parts, [](const IndexSums& part) { return part.weight == 0.0; });
  for (const IndexSums& part : parts) all.add(part, 1.0);
  if (parts.size() < 2) return indices;
  std::vector<IndexSums> without;
  for (const IndexSums& part : parts) without.emplace_back(all).add(part, -1.0);

  const boost::math::students_t student(static_cast<double>(parts.size() - 1));
  const double widths = quantile(student, 0.975);  // of half an interval, in standard errors
  const auto index = [&](double (IndexSums::*of)(std::size_t) const, std::size_t k, double& error) {
    std::vector<double> resampled;
    for (const IndexSums& sums : without) resampled.push_back((sums.*of)(k));
    error = jackknife_error(resampled);
    const double value = (all.*of)(k);
    return SampleEstimate{value, value - widths * error, value + widths * error};
  };
  for (std::size_t k = 0; k < parameters; ++k) {
    SobolIndex& found = indices.of.emplace_back();
    found.first = index(&IndexSums::first_index, k, found.first_deviation);
    found.total = index(&IndexSums::total_index, k, found.total_deviation);
  }
  return indices;
}

}  // namespace wormdrive
