#pragma once
#include <cmath>
#include <limits>

#include "core/portable.hpp"

namespace wormdrive {

/// A number and the sizes of the terms that made it: its rounding error is a few `rounding` of the size, and a value
/// within that is zero. The equations of core/ are instantiated with it unchanged.
struct Sized {
  double value = 0.0, size = 0.0;

  Sized() = default;
  Sized(double x) : value(x), size(std::abs(x)) {}  // NOLINT(google-explicit-constructor): mixes with numbers
  Sized(double x, double of_terms) : value(x), size(of_terms) {}

  Sized operator-() const { return {-value, size}; }
  friend Sized operator+(const Sized& a, const Sized& b) { return {a.value + b.value, a.size + b.size}; }
  friend Sized operator-(const Sized& a, const Sized& b) { return a + -b; }
  friend Sized operator*(const Sized& a, const Sized& b) {
    return {a.value * b.value, std::abs(a.value) * b.size + a.size * std::abs(b.value)};
  }
  friend Sized operator/(const Sized& a, const Sized& b) {
    const double ratio = a.value / b.value;
    return {ratio, (a.size + std::abs(ratio) * b.size) / std::abs(b.value)};
  }
  Sized& operator+=(const Sized& b) { return *this = *this + b; }
  Sized& operator-=(const Sized& b) { return *this = *this - b; }

  friend bool operator<(const Sized& a, const Sized& b) { return a.value < b.value; }
  friend bool operator>(const Sized& a, const Sized& b) { return a.value > b.value; }
  friend bool operator<=(const Sized& a, const Sized& b) { return a.value <= b.value; }
  friend bool operator>=(const Sized& a, const Sized& b) { return a.value >= b.value; }
};

/// What arithmetic may do to a number, as a share of its size: some units in the last place.
inline constexpr double rounding = 8.0 * std::numeric_limits<double>::epsilon();

inline Sized sin(const Sized& x) {
  const auto [sine, cosine] = sine_and_cosine(x.value);
  return {sine, std::abs(sine) + std::abs(cosine) * x.size};
}
inline Sized cos(const Sized& x) {
  const auto [sine, cosine] = sine_and_cosine(x.value);
  return {cosine, std::abs(cosine) + std::abs(sine) * x.size};
}
inline Sized exp(const Sized& x) {
  const double e = portable::exp(x.value);
  return {e, e * (1.0 + x.size)};
}

}  // namespace wormdrive
