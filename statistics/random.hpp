#pragma once
#include <array>
#include <cstdint>

#include "core/field.hpp"

namespace wormdrive {

/// Seeds are whole numbers that a double holds exactly.
inline constexpr Bounds seeds = bounds::between(0.0, 0x1p53);

/// What a random number is for: streams of one seed never overlap.
enum class Stream : std::uint64_t {
  encoder_noise = 1,
  torque_disturbance = 2,
  reference = 3,
  block_weights = 4,
  pulls = 5
};

/// Random bits without memory: they depend on seed, stream and the two counters alone, whoever asks and when;
/// Philox4x64-10 [Salmon2011].
std::array<std::uint64_t, 4> random_bits(std::uint64_t seed, std::uint64_t stream, std::uint64_t k, std::uint64_t j);

/// A random number without memory: the k-th of a stream depends on seed, stream and k alone, whoever asks and when.
double uniform(std::uint64_t seed, Stream stream, std::uint64_t k);

/// Standard normal, by Box and Muller.
double normal(std::uint64_t seed, Stream stream, std::uint64_t k);

}  // namespace wormdrive
