#include "statistics/rank_correlation.hpp"

#include <algorithm>
#include <cmath>

namespace wormdrive {

RankScale::RankScale(const Column& column, std::uint64_t count) {
  const std::uint64_t stride = std::max<std::uint64_t>(1, (count + most - 1) / most);
  std::uint64_t at = 0;
  column([&](std::span<const double> values) {
    for (const double value : values)
      if (at++ % stride == 0) ends_.push_back(value);
  });
  std::sort(ends_.begin(), ends_.end());
  ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());

  std::vector<std::uint64_t> counts(ends_.size() + 1);
  column([&](std::span<const double> values) {
    for (const double value : values) ++counts[interval(value)];
  });
  const double middle = 0.5 * (static_cast<double>(count) - 1.0);
  std::uint64_t before = 0;
  for (const std::uint64_t here : counts) {
    const double deviation = static_cast<double>(before) + 0.5 * (static_cast<double>(here) - 1.0) - middle;
    deviations_.push_back(deviation);
    squares_ += static_cast<double>(here) * deviation * deviation;
    before += here;
  }
}

std::size_t RankScale::interval(double value) const {
  return static_cast<std::size_t>(std::lower_bound(ends_.begin(), ends_.end(), value) - ends_.begin());
}

double rank_correlation(const PairColumn& pairs, const RankScale& first, const RankScale& second) {
  const double product = std::sqrt(first.squares()) * std::sqrt(second.squares());
  if (product == 0.0) return 0.0;
  double sum = 0.0;
  pairs([&](std::span<const double> x, std::span<const double> y) {
    for (std::size_t k = 0; k < x.size(); ++k) sum += first(x[k]) * second(y[k]);
  });
  return sum / product;
}

}  // namespace wormdrive
