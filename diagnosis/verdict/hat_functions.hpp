#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace wormdrive {

/// Hat functions over the quantiles of an axis.
class HatFunctions {
 public:
  HatFunctions(const std::vector<double>& x, int nodes) : x_(x) {
    std::vector<double> sorted = x;
    std::sort(sorted.begin(), sorted.end());
    const auto n = static_cast<double>(x.size());
    for (int b = 0; b < nodes; ++b)
      centre_.push_back(sorted[std::min(x.size() - 1, static_cast<std::size_t>(n * (b + 0.5) / nodes))]);
  }
  double operator()(std::size_t hat, std::size_t sample) const {
    const double x = x_[sample], c = centre_[hat];
    if (x < c && hat > 0) return std::max(0.0, 1.0 - (c - x) / std::max(1e-12, c - centre_[hat - 1]));
    if (x > c && hat + 1 < centre_.size()) return std::max(0.0, 1.0 - (x - c) / std::max(1e-12, centre_[hat + 1] - c));
    return 1.0;
  }

 private:
  const std::vector<double>& x_;
  std::vector<double> centre_;
};

}  // namespace wormdrive
