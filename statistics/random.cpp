#include "statistics/random.hpp"

#include <cmath>
#include <numbers>

#include <Random123/philox.h>

#include "core/numbers/portable.hpp"

namespace wormdrive {

std::array<std::uint64_t, 4> random_bits(std::uint64_t seed, std::uint64_t stream, std::uint64_t k, std::uint64_t j) {
  const auto bits = r123::Philox4x64()({{k, j, 0, 0}}, {{seed, stream}});
  return {bits[0], bits[1], bits[2], bits[3]};
}

double uniform(std::uint64_t seed, Stream stream, std::uint64_t k) {
  const auto bits = random_bits(seed, static_cast<std::uint64_t>(stream), k, 0);
  return (static_cast<double>(bits[0] >> 11) + 0.5) * 0x1p-53;  // in (0, 1)
}

double normal(std::uint64_t seed, Stream stream, std::uint64_t k) {
  const auto bits = random_bits(seed, static_cast<std::uint64_t>(stream), k, 1);
  const double u = (static_cast<double>(bits[0] >> 11) + 0.5) * 0x1p-53;
  const double v = static_cast<double>(bits[1] >> 11) * 0x1p-53;
  return std::sqrt(-2.0 * portable::log(u)) * portable::cos(2.0 * std::numbers::pi * v);
}

}  // namespace wormdrive
