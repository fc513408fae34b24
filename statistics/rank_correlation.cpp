#include "statistics/rank_correlation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

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
  make_guide();

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

void RankScale::make_guide() {
  const auto finite = [](double end) { return std::isfinite(end); };
  const auto first = std::find_if(ends_.begin(), ends_.end(), finite);
  if (first != ends_.end()) {
    const double range = *std::find_if(ends_.rbegin(), ends_.rend(), finite) - *first;
    least_ = *first;
    cells_per_unit_ = static_cast<double>(ends_.size()) / range;
  }
  ends_below_.assign(ends_.size() + 2, 0);
  for (const double end : ends_) ++ends_below_[cell(end) + 1];
  std::partial_sum(ends_below_.begin(), ends_below_.end(), ends_below_.begin());
}

/// Rises with the value, so that a value has to be looked for among the ends in its own cell alone.
std::size_t RankScale::cell(double value) const {
  const double place = (value - least_) * cells_per_unit_, last = static_cast<double>(ends_.size());
  return place > 0.0 ? static_cast<std::size_t>(std::min(place, last)) : 0;
}

std::size_t RankScale::interval(double value) const {
  const std::uint32_t* const below = &ends_below_[cell(value)];
  const auto at = [this](std::uint32_t k) { return ends_.begin() + static_cast<std::ptrdiff_t>(k); };
  return static_cast<std::size_t>(std::lower_bound(at(below[0]), at(below[1]), value) - ends_.begin());
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
