#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

namespace wormdrive {

/// The value that as many lie below as above; there has to be one.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// Standard deviation by the median distance from the median, which no outlier moves.
inline double robust_deviation(std::vector<double> values) {
  const double centre = median(values);
  for (double& value : values) value = std::abs(value - centre);
  return 1.4826 * median(std::move(values));
}

/// A size that all but one in two hundred values stay within.
inline double usual_peak(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  const auto peak = values.end() - static_cast<std::ptrdiff_t>(values.size() / 200 + 1);
  std::nth_element(values.begin(), peak, values.end());
  return *peak;
}

}  // namespace wormdrive
