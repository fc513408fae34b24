#include "sweep/summary/statistics.hpp"

#include <cmath>

#include <boost/math/distributions/binomial.hpp>

#include "statistics/normal.hpp"

namespace wormdrive {
namespace {
constexpr double tail = 0.025;  ///< beyond either end of a 95 % interval
}

QuantileRanks quantile_ranks(std::uint64_t n, double p) {
  using Real =
      boost::math::binomial_distribution<double, boost::math::policies::policy<boost::math::policies::discrete_quantile<
                                                     boost::math::policies::integer_round_outwards>>>;
  const auto all = static_cast<double>(n), place = p * (all - 1.0);
  QuantileRanks ranks;
  ranks.below = static_cast<std::uint64_t>(place);
  ranks.share = place - static_cast<double>(ranks.below);
  // The number of draws below the true quantile is binomial: X_(l) is above it only if fewer than l are.
  const Real number(all, p);
  double fewer = quantile(number, tail);
  while (fewer >= 0.0 && cdf(number, fewer) > tail) fewer -= 1.0;
  const double l = fewer + 1.0, u = quantile(complement(number, tail)) + 1.0;
  if (l >= 1.0) ranks.low = static_cast<std::uint64_t>(l) - 1;
  if (u <= all) ranks.high = static_cast<std::uint64_t>(u) - 1;
  return ranks;
}

SampleEstimate rank_correlation_estimate(double r, std::uint64_t n) {
  const SampleEstimate estimate{r, 0.0, 0.0};
  if (n < 4 || !(std::abs(r) < 1.0)) return estimate.without_interval();
  const double z = std::atanh(r),
               half = normal_half_width * std::sqrt((1.0 + 0.5 * r * r) / (static_cast<double>(n) - 3.0));
  return {r, std::tanh(z - half), std::tanh(z + half)};
}

SampleEstimate probability(std::uint64_t k, std::uint64_t n) {
  using Binomial = boost::math::binomial_distribution<double>;
  if (n == 0) return {std::nan(""), 0.0, 1.0};
  const auto all = static_cast<double>(n), hits = static_cast<double>(k);
  return {hits / all, k == 0 ? 0.0 : Binomial::find_lower_bound_on_p(all, hits, tail),
          k == n ? 1.0 : Binomial::find_upper_bound_on_p(all, hits, tail)};
}

}  // namespace wormdrive
