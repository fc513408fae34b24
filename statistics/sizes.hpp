#pragma once
#include <cmath>
#include <utility>
#include <vector>

#include "statistics/robust.hpp"

namespace wormdrive {

/// Root of the mean square of values; there has to be one.
inline double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Median of the sizes of values; 0 without values.
inline double median_size(std::vector<double> values) {
  if (values.empty()) return 0.0;
  for (double& value : values) value = std::abs(value);
  return median(std::move(values));
}

}  // namespace wormdrive
