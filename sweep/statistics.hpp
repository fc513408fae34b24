#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "sweep/column.hpp"

namespace wormdrive {

/// An estimate and where the truth lies with 95 % confidence.
struct SampleEstimate {
  double value, low, high;
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

/// The p-quantile from at(rank), the values; an end is infinite where the sample is too small for it.
template <class At>
SampleEstimate sample_quantile(const QuantileRanks& ranks, At&& at) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  // between the two neighbours, as numpy does
  const double below = at(ranks.below), share = ranks.share;
  return {below + (share > 0.0 ? share * (at(ranks.below + 1) - below) : 0.0), ranks.low ? at(*ranks.low) : -infinite,
          ranks.high ? at(*ranks.high) : infinite};
}

/// Probability of what happened k times in n independent trials, with the exact binomial interval [ClopperPearson1934].
SampleEstimate probability(std::uint64_t k, std::uint64_t n);

/// What share of a metric's variance a parameter makes.
struct SobolIndex {
  SampleEstimate first, total;              ///< alone; with all it takes part in
  double first_deviation, total_deviation;  ///< standard errors
};

/// Sobol indices of every parameter from a Saltelli design: values of one metric in the order of its trials, blocks of
/// parameters + 2; blocks with a value that is not finite are left out. Estimators of Saltelli 2010 for the first and
/// Jansen 1999 for the total index. Intervals come from 200 resamples that take every block as often as a Poisson
/// number of mean 1 says, so that memory does not grow with the blocks. Empty if fewer than two blocks are left or the
/// metric is constant.
std::vector<SobolIndex> sobol_indices(const Column& values, std::size_t parameters, std::uint64_t seed);

}  // namespace wormdrive
