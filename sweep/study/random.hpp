#pragma once
#include <array>
#include <cstdint>

#include "statistics/random.hpp"

namespace wormdrive {

/// What the random numbers of a sweep are for: streams of one seed never overlap, nor with those of a run.
enum class SweepStream : std::uint64_t { draws = 0x100, permutation, digital_shift, noise, subset, importance };

/// Random bits of a trial and one of its parameters.
inline std::array<std::uint64_t, 4> random_bits(std::uint64_t seed, SweepStream stream, std::uint64_t trial,
                                                std::uint64_t parameter) {
  return random_bits(seed, static_cast<std::uint64_t>(stream), trial, parameter);
}

/// The 53 leading bits as a number in (0, 1), neither end included.
constexpr double to_unit_interval(std::uint64_t bits) {
  const double u = (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
  return u < 1.0 ? u : 1.0 - 0x1p-53;
}

/// The seed of a trial's own noise; stated: that of the scenario.
inline double noise_seed(double stated, std::uint64_t seed, std::uint64_t trial) {
  return static_cast<double>(random_bits(seed, SweepStream::noise, trial, static_cast<std::uint64_t>(stated))[0] >> 11);
}

}  // namespace wormdrive
