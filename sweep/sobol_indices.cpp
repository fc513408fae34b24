#include <algorithm>
#include <cmath>

#include "sweep/random.hpp"
#include "sweep/statistics.hpp"

namespace wormdrive {
namespace {

/// The blocks of a Saltelli design that are whole.
class Blocks {
 public:
  Blocks(const std::vector<double>& values, std::size_t parameters) : values_(values), width_(parameters + 2) {
    double sum = 0.0;
    for (std::size_t at = 0; at + width_ <= values.size(); at += width_) {
      const auto begin = values.begin() + static_cast<std::ptrdiff_t>(at);
      if (!std::all_of(begin, begin + static_cast<std::ptrdiff_t>(width_), [](double v) { return std::isfinite(v); }))
        continue;
      starts_.push_back(at);
      sum += values[at] + values[at + 1];
    }
    centre_ = starts_.empty() ? 0.0 : sum / static_cast<double>(2 * starts_.size());
  }
  std::size_t count() const { return starts_.size(); }

  struct Indices {
    std::vector<double> first, total;
  };
  /// choose(j): which block stands at the j-th place.
  template <class Choose>
  Indices estimate(Choose&& choose) const {
    const std::size_t parameters = width_ - 2;
    std::vector<double> first(parameters, 0.0), total(parameters, 0.0);
    double sum = 0.0, squares = 0.0;
    for (std::size_t j = 0; j < starts_.size(); ++j) {
      const double* const f = &values_[starts_[choose(j)]];
      const double a = f[0] - centre_, b = f[1] - centre_;  // centred: the products lose no digits to the mean
      sum += a + b;
      squares += a * a + b * b;
      for (std::size_t k = 0; k < parameters; ++k) {
        const double change = (f[k + 2] - centre_) - a;
        first[k] += b * change;
        total[k] += 0.5 * change * change;
      }
    }
    const auto n = static_cast<double>(starts_.size());
    const double variance = squares / (2.0 * n) - (sum / (2.0 * n)) * (sum / (2.0 * n));
    for (std::size_t k = 0; k < parameters; ++k) {
      first[k] /= n * variance;
      total[k] /= n * variance;
    }
    return {std::move(first), std::move(total)};
  }
  bool constant() const {
    return std::all_of(starts_.begin(), starts_.end(), [this](std::size_t at) {
      return values_[at] == values_[starts_.front()] && values_[at + 1] == values_[starts_.front()];
    });
  }

 private:
  const std::vector<double>& values_;
  std::size_t width_;
  std::vector<std::size_t> starts_;
  double centre_ = 0.0;
};

constexpr std::size_t resamples = 200;

/// The middle 95 % of resampled values around an estimate.
Estimate interval(double value, std::vector<double>& resampled) {
  std::sort(resampled.begin(), resampled.end());
  return {value, resampled[resamples / 40], resampled[resamples - 1 - resamples / 40]};
}

double deviation(const std::vector<double>& values) {
  double mean = 0.0, squares = 0.0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  for (const double v : values) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

}  // namespace

std::vector<SobolIndex> sobol_indices(const std::vector<double>& values, std::size_t parameters, std::uint64_t seed) {
  const Blocks blocks(values, parameters);
  if (blocks.count() < 2 || blocks.constant()) return {};
  const Blocks::Indices best = blocks.estimate([](std::size_t j) { return j; });
  std::vector<std::vector<double>> first(parameters), total(parameters);
  for (std::size_t r = 0; r < resamples; ++r) {
    const Blocks::Indices again = blocks.estimate([&](std::size_t j) {
      return static_cast<std::size_t>(random_bits(seed, SweepStream::bootstrap, j, r)[0] % blocks.count());
    });
    for (std::size_t k = 0; k < parameters; ++k) {
      first[k].push_back(again.first[k]);
      total[k].push_back(again.total[k]);
    }
  }
  std::vector<SobolIndex> indices;
  for (std::size_t k = 0; k < parameters; ++k)
    indices.push_back({interval(best.first[k], first[k]), interval(best.total[k], total[k]), deviation(first[k]),
                       deviation(total[k])});
  return indices;
}

}  // namespace wormdrive
