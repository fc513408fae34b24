#pragma once
// The numbers in which the judge computes: 128 bits where the compiler has them, else the longest there are.
#include <cmath>
#include <limits>

#ifdef __SIZEOF_FLOAT128__
// of libquadmath; its header is GCC's alone, and other tools read this file too
extern "C" {
__float128 fabsq(__float128);
__float128 sinq(__float128);
__float128 cosq(__float128);
__float128 expq(__float128);
}
#endif

namespace judge {

using std::abs, std::cos, std::exp, std::sin;

#ifdef __SIZEOF_FLOAT128__
using Quad = __float128;
inline Quad abs(Quad x) { return fabsq(x); }
inline Quad sin(Quad x) { return sinq(x); }
inline Quad cos(Quad x) { return cosq(x); }
inline Quad exp(Quad x) { return expq(x); }
#else
using Quad = long double;
#endif

/// How many terms a power series in these numbers has, below which share of its size the rest of it stays, and what of
/// a coefficient is rounding.
template <class Real>
struct Precision {
  static constexpr int order = sizeof(Real) > 8 && std::numeric_limits<Real>::digits != 64 ? 26 : 18;
  static constexpr double rest = order == 26 ? 1e-30 : 1e-19, rounding = order == 26 ? 1e-27 : 1e-16;
};

/// A value with the sum of the sizes of the terms that it was made of: what its rounding in doubles is a share of.
struct Sized {
  Quad value;
  double size;

  Sized(Quad x) : value(x), size(std::abs(static_cast<double>(x))) {}  // NOLINT(google-explicit-constructor)
  Sized(Quad x, double m) : value(x), size(m) {}

  friend Sized operator+(const Sized& a, const Sized& b) { return {a.value + b.value, a.size + b.size}; }
  friend Sized operator-(const Sized& a, const Sized& b) { return {a.value - b.value, a.size + b.size}; }
  friend Sized operator*(const Sized& a, const Sized& b) { return {a.value * b.value, a.size * b.size}; }
  friend Sized operator/(const Sized& a, const Sized& b) {
    const double divisor = std::abs(static_cast<double>(b.value));
    return {a.value / b.value, a.size / divisor * (b.size / divisor)};
  }
  friend Sized sin(const Sized& x) { return {sin(x.value), 1.0 + x.size}; }
  friend Sized cos(const Sized& x) { return {cos(x.value), 1.0 + x.size}; }
  friend Sized exp(const Sized& x) {
    const Quad value = exp(x.value);
    return {value, static_cast<double>(value) * (1.0 + x.size)};
  }
};

}  // namespace judge
