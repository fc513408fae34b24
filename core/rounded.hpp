#pragma once
#include <cmath>
#include <limits>

#include "core/jet.hpp"
#include "core/portable.hpp"
#include "core/series.hpp"

namespace wormdrive {

/// A number with a bound of the rounding it carries, for what has to be decided at zero: a value below its own rounding
/// has no sign. Every number that enters is taken as rounded once.
///
/// Source: running error analysis, N. J. Higham, Accuracy and Stability of Numerical Algorithms, section 3.3.
struct Rounded {
  double value = 0.0;
  double rounding = 0.0;  ///< >= |value - exact value|, to first order

  Rounded() = default;
  Rounded(double number, double bound) : value(number), rounding(bound) {}
  /// Of a parameter, whose derivatives decide nothing.
  template <class T>
  requires requires(const T& x) { value_of(x); }
  Rounded(const T& x) : Rounded(rounded(value_of(x), 0.0)) {}  // NOLINT(google-explicit-constructor): a scalar

  /// What one operation rounds, as a share of its result.
  static constexpr double unit = 0.5 * std::numeric_limits<double>::epsilon();

  bool vanishes() const { return !(std::abs(value) > rounding); }

  Rounded& operator+=(const Rounded& b) { return *this = *this + b; }
  Rounded& operator-=(const Rounded& b) { return *this = *this - b; }
  Rounded operator-() const { return {-value, rounding}; }
  friend Rounded operator+(const Rounded& a, const Rounded& b) {
    return rounded(a.value + b.value, a.rounding + b.rounding);
  }
  friend Rounded operator-(const Rounded& a, const Rounded& b) { return a + -b; }
  friend Rounded operator*(const Rounded& a, const Rounded& b) {
    return rounded(a.value * b.value, std::abs(a.value) * b.rounding + std::abs(b.value) * a.rounding);
  }
  friend Rounded operator/(const Rounded& a, const Rounded& b) {
    const double ratio = a.value / b.value;
    return rounded(ratio, (a.rounding + std::abs(ratio) * b.rounding) / std::abs(b.value));
  }
  friend bool operator<=(const Rounded& a, const Rounded& b) { return a.value <= b.value; }
  friend bool operator<(const Rounded& a, const Rounded& b) { return a.value < b.value; }
  friend bool operator>=(const Rounded& a, const Rounded& b) { return b <= a; }
  friend bool operator>(const Rounded& a, const Rounded& b) { return b < a; }

  // portable:: is exact to two roundings
  friend Rounded sin(const Rounded& x) { return of_function(portable::sin(x.value), portable::cos(x.value), x); }
  friend Rounded cos(const Rounded& x) { return of_function(portable::cos(x.value), -portable::sin(x.value), x); }
  friend Rounded exp(const Rounded& x) {
    const double y = portable::exp(x.value);
    return of_function(y, y, x);
  }

 private:
  /// The result of an operation, rounded once more.
  static Rounded rounded(double value, double rounding) { return {value, rounding + unit * std::abs(value)}; }
  static Rounded of_function(double value, double slope, const Rounded& x) {
    return rounded(value, (std::abs(slope) + x.rounding) * x.rounding + unit * std::abs(value));
  }
};

/// Adds a rounding that a value has from elsewhere.
inline void widen(Rounded& x, double rounding) { x.rounding += rounding; }
template <int N>
void widen(Series<Rounded, N>& x, double rounding) {
  widen(x[0], rounding);
}

/// How well the time of an event at t is known [s]: root finders stop within a few roundings of it.
inline double time_resolution(double t) { return 4.0 * std::numeric_limits<double>::epsilon() * std::abs(t); }

/// How many leading coefficients do not decide the sign of a series just after the present moment: they vanish within
/// their rounding, or a later one outweighs them before the sum has left the rounding of its value. N + 1 where nothing
/// is left. resolution [s]: how well the present moment is known, as that of a root that was found.
template <int N>
int undecided(const Series<Rounded, N>& x, double resolution) {
  const double next = N > 0 ? std::abs(x[N > 0 ? 1 : 0].value) * resolution : 0.0;
  const double blur = x[0].rounding + next;  // what is not known of the value
  if (std::abs(x[0].value) > blur) return 0;
  for (int k = 1; k <= N; ++k) {
    if (x[k].vanishes()) continue;
    // within this time [s] it has left the blur, and a dip of that depth would have turned
    const double size = std::abs(x[k].value), left = std::pow(4.0 * blur / size, 1.0 / k);
    bool outweighed = false;
    double power = left;
    for (int j = k + 1; j <= N; ++j, power *= left)
      outweighed = outweighed || (!x[j].vanishes() && std::abs(x[j].value) * power > size);
    if (!outweighed) return k;
  }
  return N + 1;
}

/// Sign of a series just after the present moment, 0 where it vanishes within its rounding. resolution as above.
template <int N>
int sign_just_after(const Series<Rounded, N>& x, double resolution) {
  const int k = undecided(x, resolution);
  return k > N ? 0 : x[k].value > 0.0 ? 1 : -1;
}

}  // namespace wormdrive
