#include "sweep/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <boost/math/distributions/binomial.hpp>

namespace wormdrive {
namespace {
constexpr double tail = 0.025;  ///< beyond either end of a 95 % interval
}

Estimate sample_quantile(const std::vector<double>& rising, double p) {
  using Real =
      boost::math::binomial_distribution<double, boost::math::policies::policy<boost::math::policies::discrete_quantile<
                                                     boost::math::policies::integer_round_outwards>>>;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const std::size_t n = rising.size();
  if (n == 0) return {std::nan(""), -infinite, infinite};
  // between the two neighbours, as numpy does
  const double place = p * static_cast<double>(n - 1);
  const auto below = static_cast<std::size_t>(place);
  const double share = place - static_cast<double>(below);
  const double value = rising[below] + (share > 0.0 ? share * (rising[below + 1] - rising[below]) : 0.0);
  // The number of draws below the true quantile is binomial: X_(l) is above it only if fewer than l are.
  const Real number(static_cast<double>(n), p);
  double fewer = quantile(number, tail);
  while (fewer >= 0.0 && cdf(number, fewer) > tail) fewer -= 1.0;
  const double l = fewer + 1.0, u = quantile(complement(number, tail)) + 1.0;
  const double low = l >= 1.0 ? rising[static_cast<std::size_t>(l) - 1] : -infinite;
  const double high = u <= static_cast<double>(n) ? rising[static_cast<std::size_t>(u) - 1] : infinite;
  return {value, low, high};
}

Estimate probability(std::uint64_t k, std::uint64_t n) {
  using Binomial = boost::math::binomial_distribution<double>;
  if (n == 0) return {std::nan(""), 0.0, 1.0};
  const auto all = static_cast<double>(n), hits = static_cast<double>(k);
  return {hits / all, k == 0 ? 0.0 : Binomial::find_lower_bound_on_p(all, hits, tail),
          k == n ? 1.0 : Binomial::find_upper_bound_on_p(all, hits, tail)};
}

Ranks::Ranks(const std::vector<double>& values) : deviations_(values.size()) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  const double middle = 0.5 * (static_cast<double>(values.size()) - 1.0);
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first + 1;
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    const double deviation = 0.5 * static_cast<double>(first + end - 1) - middle;
    for (; first < end; ++first) deviations_[order[first]] = deviation;
  }
  for (const double deviation : deviations_) squares_ += deviation * deviation;
}

double Ranks::correlation(const Ranks& other) const {
  const double product = std::sqrt(squares_) * std::sqrt(other.squares_);
  if (product == 0.0) return 0.0;
  return std::inner_product(deviations_.begin(), deviations_.end(), other.deviations_.begin(), 0.0) / product;
}

}  // namespace wormdrive
