#pragma once
#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace wormdrive {

/// A table made smooth: monotone cubic between its points (at least four), the end values beyond them; without points
/// zero.
class CubicTable {
 public:
  CubicTable() = default;
  CubicTable(std::vector<double> x, std::vector<double> y);
  /// With the slopes of what is tabulated, which may then have fewer points: the cubics are as monotone as it is where
  /// no slope exceeds three times that of the chord beside it.
  CubicTable(std::vector<double> x, std::vector<double> y, std::vector<double> slopes)
      : x_(std::move(x)), y_(std::move(y)), slopes_(std::move(slopes)) {}

  /// One of the cubics: value + s (slope + s (second + s third)), s = x - begin, up to where the next one begins.
  struct Cubic {
    double begin, end, value, slope, second, third;
  };
  /// That which begins at the k-th point.
  Cubic cubic(std::size_t k) const {
    const double h = x_[k + 1] - x_[k], rise = (y_[k + 1] - y_[k]) / h;
    return {x_[k],
            x_[k + 1],
            y_[k],
            slopes_[k],
            (3.0 * rise - 2.0 * slopes_[k] - slopes_[k + 1]) / h,
            (slopes_[k] + slopes_[k + 1] - 2.0 * rise) / (h * h)};
  }

  /// The value at x, which may carry derivatives.
  template <class S>
  S operator()(const S& x) const {
    if (x_.empty()) return S(0.0);
    if constexpr (requires { look_up(*this, x); }) return look_up(*this, x);
    if (!(x > S(x_.front()))) return x <= S(x_.front()) ? S(y_.front()) : x;  // or it is no number
    if (x >= S(x_.back())) return S(y_.back());
    const auto after = std::upper_bound(x_.begin(), x_.end(), x, [](const S& a, double b) { return a < S(b); });
    const Cubic c = cubic(static_cast<std::size_t>(after - x_.begin()) - 1);
    const S s = x - c.begin;
    return c.value + s * (c.slope + s * (c.second + s * c.third));
  }

  bool operator==(const CubicTable&) const = default;

  /// Between two neighbouring points; infinity without any.
  double least_interval() const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < x_.size(); ++k) least = std::min(least, x_[k] - x_[k - 1]);
    return least;
  }
  /// Where one cubic ends and the next begins.
  const std::vector<double>& points() const { return x_; }
  const std::vector<double>& values() const { return y_; }

 private:
  std::vector<double> x_, y_, slopes_;
};

}  // namespace wormdrive
