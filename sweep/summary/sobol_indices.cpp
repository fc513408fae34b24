#include "sweep/summary/sobol_indices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "statistics/student_t.hpp"
#include "sweep/summary/blocks.hpp"

namespace wormdrive {
namespace {

// The values of a sample are those at A, at B, at A with one parameter after the other from B, and at B with one after
// the other from A where pairs have indices.

/// What indices are worked out from.
class IndexSums {
 public:
  IndexSums(std::size_t parameters, bool second_order)
      : parameters_(parameters),
        first_(parameters),
        total_(parameters),
        together_(second_order ? parameters * parameters : 0) {}

  bool empty() const { return weight_ == 0.0; }
  /// centred: values of a sample less about their mean, so that the products lose no digits to it.
  void add(const std::vector<double>& centred) {
    const double a = centred[0], b = centred[1];
    const std::span<const double> mostly_A = std::span(centred).subspan(2, parameters_),
                                  mostly_B = std::span(centred).subspan(2 + parameters_);
    weight_ += 1.0;
    sum_ += a + b;
    squares_ += a * a + b * b;
    for (std::size_t k = 0; k < parameters_; ++k) {
      const double change = mostly_A[k] - a;
      first_[k] += b * change;
      total_[k] += 0.5 * change * change;
      if (together_.empty()) continue;
      for (std::size_t j = 0; j < k; ++j)  // both share k and j alone
        together_[k * parameters_ + j] += 0.5 * (mostly_B[j] * mostly_A[k] + mostly_B[k] * mostly_A[j]) - a * b;
    }
  }
  /// sign: +1 adds other sums, -1 takes them away.
  void add(const IndexSums& other, double sign) {
    weight_ += sign * other.weight_;
    sum_ += sign * other.sum_;
    squares_ += sign * other.squares_;
    const auto add_all = [sign](std::vector<double>& to, const std::vector<double>& from) {
      for (std::size_t k = 0; k < to.size(); ++k) to[k] += sign * from[k];
    };
    add_all(first_, other.first_);
    add_all(total_, other.total_);
    add_all(together_, other.together_);
  }
  double first(std::size_t k) const { return first_[k] / (weight_ * variance()); }
  double total(std::size_t k) const { return total_[k] / (weight_ * variance()); }
  /// Of a pair, j < k.
  double pair(std::size_t j, std::size_t k) const {
    return together_[k * parameters_ + j] / (weight_ * variance()) - first(j) - first(k);
  }

 private:
  double variance() const {
    const double mean = sum_ / (2.0 * weight_);
    return squares_ / (2.0 * weight_) - mean * mean;
  }

  std::size_t parameters_;
  double weight_ = 0.0, sum_ = 0.0, squares_ = 0.0;
  std::vector<double> first_, total_;
  std::vector<double> together_;  ///< of every pair; none where these have no indices
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

SobolIndices sobol_indices(const Column& values, const Saltelli& design, std::size_t parameters) {
  SobolIndices indices;
  const std::uint64_t rows = design.rows(parameters);
  double centre = 0.0, some = 0.0;
  bool constant = true;
  for_each_block(values, rows, [&](std::uint64_t, const std::vector<double>& f) {
    if (!is_whole(f)) {
      ++indices.left_out;
      return;
    }
    if (indices.used++ == 0) some = f[0];
    constant = constant && f[0] == some && f[1] == some;
    centre += (0.5 * (f[0] + f[1]) - centre) / static_cast<double>(indices.used);
  });
  if (constant) return indices;

  const IndexSums none(parameters, design.second_order);
  IndexSums all = none;
  std::vector<IndexSums> parts(Saltelli::replicates, none);
  for_each_block(values, rows, [&](std::uint64_t sample, std::vector<double>& f) {
    if (!is_whole(f)) return;
    for (double& value : f) value -= centre;
    parts[sample % Saltelli::replicates].add(f);
  });
  std::erase_if(parts, [](const IndexSums& part) { return part.empty(); });
  for (const IndexSums& part : parts) all.add(part, 1.0);
  if (parts.size() < 2) return indices;
  std::vector<IndexSums> without;
  for (const IndexSums& part : parts) without.emplace_back(all).add(part, -1.0);

  const double widths = t_quantile(parts.size() - 1);  // of half an interval, in standard errors
  const auto estimate = [&](auto&& of, double* error = nullptr) {
    std::vector<double> resampled;
    for (const IndexSums& sums : without) resampled.push_back(of(sums));
    const double deviation = jackknife_error(resampled), value = of(all);
    if (error) *error = deviation;
    return SampleEstimate{value, value - widths * deviation, value + widths * deviation};
  };
  for (std::size_t k = 0; k < parameters; ++k) {
    SobolIndex& found = indices.of.emplace_back();
    found.first = estimate([k](const IndexSums& sums) { return sums.first(k); }, &found.first_deviation);
    found.total = estimate([k](const IndexSums& sums) { return sums.total(k); }, &found.total_deviation);
    for (std::size_t j = 0; design.second_order && j < k; ++j)
      indices.pairs.push_back({j, k, estimate([j, k](const IndexSums& sums) { return sums.pair(j, k); })});
  }
  return indices;
}

}  // namespace wormdrive
