#pragma once
#include "statistics/normal.hpp"
#include "sweep/rare/limit_state.hpp"
#include "sweep/study/random.hpp"

namespace wormdrive {

/// Independent standard normal numbers that depend on seed, stream and index alone.
inline NormalPoint normal_draws(std::uint64_t seed, SweepStream stream, std::uint64_t index, std::size_t count) {
  NormalPoint draws(count);
  for (std::size_t k = 0; k < count; ++k)
    draws[k] = normal_quantile(to_unit_interval(random_bits(seed, stream, index, k)[0]));
  return draws;
}

}  // namespace wormdrive
