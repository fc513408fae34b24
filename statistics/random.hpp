#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>

#include <Random123/philox.h>

#include "core/field.hpp"
#include "core/numbers/portable.hpp"

namespace wormdrive {

/// Seeds are whole numbers that a double holds exactly.
inline constexpr Bounds seeds = bounds::between(0.0, 0x1p53);

/// What a random number is for: streams of one seed never overlap.
enum class Stream : std::uint64_t { encoder_noise = 1, torque_disturbance = 2, reference = 3 };

/// A random number without memory: the k-th of a stream depends on seed, stream and k alone, whoever asks and when.
[[gnu::noinline]] inline double uniform(std::uint64_t seed, Stream stream, std::uint64_t k) {
  const auto bits = r123::Philox4x64()({{k, 0, 0, 0}}, {{seed, static_cast<std::uint64_t>(stream)}});
  return (static_cast<double>(bits[0] >> 11) + 0.5) * 0x1p-53;  // in (0, 1)
}

/// Standard normal, by Box and Muller.
[[gnu::noinline]] inline double normal(std::uint64_t seed, Stream stream, std::uint64_t k) {
  const auto bits = r123::Philox4x64()({{k, 1, 0, 0}}, {{seed, static_cast<std::uint64_t>(stream)}});
  const double u = (static_cast<double>(bits[0] >> 11) + 0.5) * 0x1p-53;
  const double v = static_cast<double>(bits[1] >> 11) * 0x1p-53;
  return std::sqrt(-2.0 * portable::log(u)) * portable::cos(2.0 * std::numbers::pi * v);
}

}  // namespace wormdrive
