#pragma once
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

namespace wormdrive {

/// A point of standard normal space, a coordinate for each uncertain parameter.
using NormalPoint = std::vector<double>;

/// How far drives are from a limit, at points of standard normal space, each with the noise of an index: at most 0
/// where the limit is missed, -infinity where a drive cannot say.
using LimitState =
    std::function<std::vector<double>(const std::vector<NormalPoint>& points, const std::vector<std::uint64_t>& noise)>;

/// Indices of count points, each its own.
inline std::vector<std::uint64_t> indices_from(std::uint64_t first, std::size_t count) {
  std::vector<std::uint64_t> list(count);
  std::iota(list.begin(), list.end(), first);
  return list;
}

/// The probability of a miss, as it was estimated.
struct RareEstimate {
  double probability = 0.0;
  double variation = 0.0;         ///< coefficient of variation of the estimate
  double low = 0.0, high = 0.0;   ///< 95 % interval
  std::uint64_t evaluations = 0;  ///< of the limit state
};

}  // namespace wormdrive
