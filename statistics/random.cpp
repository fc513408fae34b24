#include "statistics/random.hpp"

#include <cmath>
#include <numbers>

#include <Random123/philox.h>

#include "core/numbers/portable.hpp"

namespace wormdrive {

double uniform(std::uint64_t seed, Stream stream, std::uint64_t k) {
  const auto bits = r123::Philox4x64()({{k, 0, 0, 0}}, {{seed, static_cast<std::uint64_t>(stream)}});
  return (static_cast<double>(bits[0] >> 11) + 0.5) * 0x1p-53;  // in (0, 1)
}

double normal(std::uint64_t seed, Stream stream, std::uint64_t k) {
  const auto bits = r123::Philox4x64()({{k, 1, 0, 0}}, {{seed, static_cast<std::uint64_t>(stream)}});
  const double u = (static_cast<double>(bits[0] >> 11) + 0.5) * 0x1p-53;
  const double v = static_cast<double>(bits[1] >> 11) * 0x1p-53;
  return std::sqrt(-2.0 * portable::log(u)) * portable::cos(2.0 * std::numbers::pi * v);
}

}  // namespace wormdrive
