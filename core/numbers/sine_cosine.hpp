#pragma once
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/numbers/lanes.hpp"

namespace wormdrive {

/// Sine and cosine of one angle.
template <class V>
struct SineAndCosineOf {
  V sine, cosine;
};
using SineAndCosine = SineAndCosineOf<double>;

/// Those of the sum of two angles.
template <class V>
[[gnu::always_inline]] inline SineAndCosineOf<V> of_sum(const SineAndCosineOf<V>& a, const SineAndCosineOf<V>& b) {
  return {a.sine * b.cosine + a.cosine * b.sine, a.cosine * b.cosine - a.sine * b.sine};
}

/// sin x and cos x, x in rad: wrong by less than one unit in the last place for |x| < 1e6, and the same bits on every
/// machine, for it takes IEEE additions and multiplications alone. A C library picks its variant by the processor.
inline SineAndCosine sine_and_cosine(double x);

namespace quarter_turn {

// pi/2 in pieces; the first three have 33 bits, so that their products with a whole number below 2^20 are exact.
inline constexpr double p1 = 0x1.921fb54400000p+0, p2 = 0x1.0b4611a600000p-34, p3 = 0x1.3198a2e000000p-69,
                        p4 = 0x1.b839a252049c1p-104;
inline constexpr double p2_and_rest = 0x1.0b4611a626331p-34;
inline constexpr double two_over_pi = 0x1.45f306dc9c883p-1;

/// An angle as the sum of a double and its rounding error [rad].
struct Reduced {
  double high, low;
};

/// x - k pi/2 where little is left of x: every rounding error is kept.
[[gnu::noinline, gnu::cold]] inline Reduced cancelled(double x, double k) {
  const auto minus = [](double a, double b) {
    const double d = a - b, back = a - d;
    return Reduced{d, (back - b) + (a - (d + back))};
  };
  const Reduced first = minus(x - k * p1, k * p2), second = minus(first.high, k * p3);
  const double rest = (first.low + second.low) - k * p4, high = second.high + rest;
  return {high, (second.high - high) + rest};
}

/// Sine and cosine behind their first terms, in z = x^2 for x in [-pi/4, pi/4]:
/// x - (x^3 third - x^5 tail[0]) and 1 - z/2 + z^2 tail[1].
template <class V>
[[gnu::always_inline]] inline Both<V> tail(const V& z) {
  // Best approximations, side by side in one register: relative errors 4e-18 and 6e-20.
  constexpr Pair c0{0x1.111111110f7cap-7, 0x1.555555555554bp-5}, c1{-0x1.a01a019bfd185p-13, -0x1.6c16c16c14f8ap-10},
      c2{0x1.71de356712922p-19, 0x1.a01a019c83914p-16}, c3{-0x1.ae5e59f5bb6eep-26, -0x1.27e4f7ea37c18p-22},
      c4{0x1.5d8fa329313c3p-33, 0x1.1ee9d752aa1dcp-29}, c5{0.0, -0x1.8fa465f95b916p-37};
  const V z2 = z * z;
  return ((both<V>(c0) + z * both<V>(c1)) + z2 * (both<V>(c2) + z * both<V>(c3))) +
         (z2 * z2) * (both<V>(c4) + z * both<V>(c5));
}
inline constexpr double third = 0x1.5555555555548p-3;     ///< near 1/3!
inline constexpr double furthest = 0x1.921fb54442d18p-1;  ///< pi/4, up to which nothing has to be reduced [rad]

/// Sine and cosine of an angle in [-pi/4, pi/4].
template <class V>
[[gnu::always_inline]] inline Both<V> within(const V& x) {
  const V z = x * x, half = 0.5 * z, near_one = 1.0 - half, cube = z * x;
  const Both<V> rest = tail(z);
  return Both<V>{x - (cube * third - (cube * z) * rest[0]), near_one + (((1.0 - near_one) - half) + (z * z) * rest[1])};
}
/// The same with the rounding error of the angle: sin(x + low) = sin x + low cos x, cos(x + low) = cos x - low sin x.
template <class V>
[[gnu::always_inline]] inline Both<V> within(const V& x, const V& low) {
  const V z = x * x, half = 0.5 * z, near_one = 1.0 - half, cube = z * x;
  const Both<V> rest = tail(z);
  return Both<V>{x - ((cube * third - near_one * low) - (cube * z) * rest[0]),
                 near_one + ((((1.0 - near_one) - half) - x * low) + (z * z) * rest[1])};
}

/// What the C library finds, for angles that are too large for the reduction.
[[gnu::noinline, gnu::cold]] inline Pair of_library(double x) { return Pair{std::sin(x), std::cos(x)}; }

inline constexpr double to_whole = 0x1.8p52;  ///< added to a double it leaves the nearest whole number in the last bits

/// Turned back by k quarter turns, k in the last bits of `shifted`; without a branch: factors 0 and +-1 are exact.
[[gnu::always_inline]] inline Pair turned_back(Pair unturned, double shifted) {
  static constexpr std::array<Pair, 4> same{Pair{1.0, 1.0}, Pair{0.0, 0.0}, Pair{-1.0, -1.0}, Pair{0.0, 0.0}};
  static constexpr std::array<Pair, 4> other{Pair{0.0, 0.0}, Pair{1.0, -1.0}, Pair{0.0, 0.0}, Pair{-1.0, 1.0}};
  const auto quarter = std::bit_cast<std::uint64_t>(shifted) & 3U;
  return same[quarter] * unturned + other[quarter] * Pair{unturned[1], unturned[0]};
}

/// Sine and cosine of any angle.
[[gnu::noinline]] inline Pair turned(double x) {
  if (!(std::abs(x) < 1e6)) [[unlikely]]
    return of_library(x);
  const double shifted = x * two_over_pi + to_whole, k = shifted - to_whole;
  const double first = x - k * p1, second = k * p2_and_rest;
  Reduced r{first - second, 0.0};
  r.low = (first - r.high) - second;
  if (std::abs(r.high) < 0x1p-10) [[unlikely]]
    r = cancelled(x, k);
  return turned_back(within(r.high, r.low), shifted);
}

}  // namespace quarter_turn

[[gnu::always_inline]] inline SineAndCosine sine_and_cosine(double x) {
  using namespace quarter_turn;
  const Pair both = std::abs(x) < furthest ? within(x) : turned(x);
  return {both[0], both[1]};
}

/// sin and cos of 2 pi turns: quarters of a turn are taken off exactly, whatever is left is right to the last place but
/// one. |turns| < 2^50.
[[gnu::always_inline]] inline SineAndCosine sine_and_cosine_of_turns(double turns) {
  using namespace quarter_turn;
  const double quarters = 4.0 * turns, shifted = quarters + to_whole;
  const Pair both = turned_back(within((quarters - (shifted - to_whole)) * (0.5 * std::numbers::pi)), shifted);
  return {both[0], both[1]};
}

}  // namespace wormdrive
