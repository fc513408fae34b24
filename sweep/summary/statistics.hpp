#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "statistics/column.hpp"

namespace wormdrive {

/// An estimate and where the truth lies with 95 % confidence, which are not numbers where there is no telling: of
/// values that are no sample.
struct SampleEstimate {
  double value, low, high;

  bool has_interval() const { return !std::isnan(low); }
  SampleEstimate without_interval() const { return {value, std::nan(""), std::nan("")}; }
};

/// Which values of a sample, by their ranks counted from 0, tell its p-quantile and where the true one lies; nothing at
/// an end for which the sample is too small.
struct QuantileRanks {
  std::uint64_t below;  ///< of the neighbour below
  double share;         ///< of the way from there to the next one
  std::optional<std::uint64_t> low, high;
};

/// For a sample of n independent draws, n > 0; the interval is exact and needs no assumption about their distribution
/// [Hahn1991].
QuantileRanks quantile_ranks(std::uint64_t n, double p);

/// The p-quantile from at(rank), the values, infinite ones among them; an end of its interval is infinite where the
/// sample is too small for it.
template <class At>
SampleEstimate sample_quantile(const QuantileRanks& ranks, At&& at) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  // between the two neighbours, as numpy does
  double value = at(ranks.below);
  if (ranks.share > 0.0)
    if (const double next = at(ranks.below + 1); std::isfinite(value) && next != value)
      value += ranks.share * (next - value);
  return {value, ranks.low ? at(*ranks.low) : -infinite, ranks.high ? at(*ranks.high) : infinite};
}

/// Probability of what happened k times in n independent trials, with the exact binomial interval [ClopperPearson1934].
SampleEstimate probability(std::uint64_t k, std::uint64_t n);

/// Spearman's rank correlation of n independent pairs with the interval of Fisher's z, whose variance is (1 + r^2/2)
/// over n - 3 [BonettWright2000]; none for fewer than four pairs, or where ranks agree completely.
SampleEstimate rank_correlation_estimate(double r, std::uint64_t n);

}  // namespace wormdrive
