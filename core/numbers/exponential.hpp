#pragma once
#include <bit>
#include <cstdint>

#include "core/numbers/lanes.hpp"

namespace wormdrive {

/// 2^k of the whole number k in the last bits of a double.
inline double power_of_two(double shifted) {
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023U) << 52U);
}

/// e^x for -707 <= x < 709, wrong by less than one unit in the last place, and the same bits on every machine (a C
/// library picks its variant by the processor); of one number or of several at once.
template <class V>
inline V exponential(const V& x) {
  constexpr double log2_e = 0x1.71547652b82fep+0;
  constexpr double ln2 = 0x1.62e42fee00000p-1, ln2_rest = 0x1.a39ef35793c76p-33;  // k ln2 is exact
  constexpr double to_whole = 0x1.8p52;  // added to a double it leaves the nearest whole number in the last bits
  const V shifted = to_whole + x * log2_e, k = shifted - to_whole;
  const V r = (x - k * ln2) - k * ln2_rest;  // e^x = 2^k e^r, |r| <= ln 2/2
  const V r2 = r * r, r4 = r2 * r2;
  const V tail = ((1.0 / 2 + r * (1.0 / 6)) + r2 * (1.0 / 24 + r * (1.0 / 120))) +
                 r4 * (((1.0 / 720 + r * (1.0 / 5040)) + r2 * (1.0 / 40320 + r * (1.0 / 362880))) +
                       r4 * ((1.0 / 3628800 + r * (1.0 / 39916800)) + r2 * (1.0 / 479001600 + r * (1.0 / 6227020800))));
  return power_of_two(shifted) * (1.0 + (r + r2 * tail));
}

/// e^-x for x >= 0, zero where that is less than 1e-307; of one number or of several at once.
template <class V>
inline V decay(const V& x) {
  constexpr double nothing_left = 707.0;
  return select(x > V(nothing_left), V(0.0), exponential(-least<V>(x, V(nothing_left))));
}

}  // namespace wormdrive
