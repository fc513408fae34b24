#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/numbers/jet.hpp"
#include "core/numbers/portable.hpp"
#include "core/numbers/series.hpp"
#include "core/numbers/sine_cosine.hpp"

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
  friend SineAndCosineOf<Rounded> sine_and_cosine(const Rounded& x) {
    const SineAndCosine at = wormdrive::sine_and_cosine(x.value);
    return {of_function(at.sine, at.cosine, x), of_function(at.cosine, -at.sine, x)};
  }
  friend Rounded sin(const Rounded& x) { return sine_and_cosine(x).sine; }
  friend Rounded cos(const Rounded& x) { return sine_and_cosine(x).cosine; }
  friend Rounded sqrt(const Rounded& x) {
    const double y = std::sqrt(x.value);
    return rounded(y, x.rounding / y);
  }
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

/// Within what is not known of it, as blur() has that.
inline bool is_zero(const Rounded& x) { return !(std::abs(x.value) > 8.0 * x.rounding); }

/// Adds a rounding that a value has from elsewhere.
inline void widen(Rounded& x, double rounding) { x.rounding += rounding; }
template <int N>
void widen(Series<Rounded, N>& x, double rounding) {
  widen(x[0], rounding);
}

/// How well the time of an event at t is known [s]: root finders stop within a few roundings of it.
inline double time_resolution(double t) { return 4.0 * std::numeric_limits<double>::epsilon() * std::abs(t); }

/// What is not known of a coefficient: some of its roundings, for the state at an event carries those of the solver's
/// polynomials, and what it changes within the resolution of time [s].
template <int N>
double blur(const Series<Rounded, N>& x, int k, double resolution) {
  const double rate = k < N ? (k + 1) * std::abs(x[k < N ? k + 1 : k].value) : 0.0;
  return 8.0 * x[k].rounding + rate * resolution;
}

/// Whether the coefficient two before the k-th lifts a series by more than a few roundings to the other side before the
/// k-th takes it back, as in a swing, which comes back again: then neither decides.
template <int N>
bool swings(const Series<Rounded, N>& x, int k, double resolution) {
  const int j = k - 2;
  if (j < 1 || std::abs(x[j].value) <= blur(x, j, resolution)) return false;
  const double opposed = -x[j].value / x[k].value;
  if (opposed <= 0.0) return false;
  const double turns = std::sqrt(opposed * j / k);  // where |x_j| s^j - |x_k| s^k is highest [s]
  const double highest = std::abs(x[j].value) * std::pow(turns, j) * 2.0 / k;
  return highest > blur(x, 0, resolution) / 4.0;
}

/// How many leading coefficients do not decide the sign of a series just after the present moment: they vanish within
/// what is known of them, or a later one outweighs them before they show. More than N where nothing decides, as where a
/// swing is no larger than what is not known of it.
/// resolution [s]: how well the present moment is known, as that of a root that was found.
///
/// Four coefficients are looked at, whatever the order, so that all who judge one quantity come to one result; a value
/// that is exactly zero, as a speed that starts, is judged by its rate, as whoever let it start judged that.
template <int N>
int undecided(const Series<Rounded, N>& x, double resolution) {
  if constexpr (N > 0)
    if (x[0].value == 0.0 && x[0].rounding == 0.0) {
      Series<Rounded, N - 1> rate;
      for (int k = 0; k < N; ++k) rate[k] = {(k + 1) * x[k + 1].value, (k + 1) * x[k + 1].rounding};
      // what starts and goes ever faster, as one whose friction falls, has begun whenever that was
      if constexpr (N > 1)
        if (std::abs(rate[0].value) > blur(rate, 0, 0.0) && rate[0].value * rate[1].value > 0.0) return 1;
      const int k = undecided(rate, resolution);
      // a motion that changes faster than time is resolved is not blurred by it: its state is known
      return 1 + (k > N - 1 ? undecided(rate, 0.0) : k);
    }
  constexpr int last = N < 3 ? N : 3;
  for (int k = 0; k <= last; ++k) {
    const double size = std::abs(x[k].value);
    if (size <= blur(x, k, resolution)) continue;
    double hidden = 0.0;  // how long [s] what is not known of the others hides this term, and the dip that it makes
    for (int j = 0; j < k; ++j) hidden = std::max(hidden, std::pow(4.0 * blur(x, j, resolution) / size, 1.0 / (k - j)));
    bool outweighed = false;
    double power = hidden;
    for (int j = k + 1; j <= last; ++j, power *= hidden)
      outweighed = outweighed || (std::abs(x[j].value) > blur(x, j, resolution) && std::abs(x[j].value) * power > size);
    if (!outweighed) return swings(x, k, resolution) ? N + 1 : k;
  }
  return N + 1;
}

/// The same for what most starts come to: value or rate decide by far. Only these come with their rounding; second and
/// third are the coefficients behind them, with some of their own. Nothing where it takes undecided() to tell.
inline std::optional<int> undecided_at_once(const Series<Rounded, 1>& x, double second, double third,
                                            double resolution) {
  if (std::abs(x[0].value) > blur(x, 0, resolution)) return 0;
  constexpr double far = 4.0;
  const double size = std::abs(x[1].value);
  const double unknown = blur(x, 1, resolution) + 2.0 * std::abs(second) * resolution;
  if (!(size > far * unknown)) return std::nullopt;
  const double hidden = 4.0 * blur(x, 0, resolution) / size;
  const bool outweighed = far * hidden * std::max(std::abs(second), std::abs(third) * hidden) > size;
  return outweighed ? std::nullopt : std::optional(1);
}

/// How far a series may seem to go to the wrong side before the coefficient that decides outweighs what is not known of
/// those before it; resolution as above.
template <int N>
double doubt(const Series<Rounded, N>& x, int decides, double resolution) {
  double hidden = 0.0, sum = blur(x, 0, resolution), power = 1.0;
  for (int j = 0; j < decides; ++j)
    hidden = std::max(hidden, std::pow(4.0 * blur(x, j, resolution) / std::abs(x[decides].value), 1.0 / (decides - j)));
  for (int j = 1; j < decides; ++j) sum += blur(x, j, resolution) * (power *= hidden);
  return sum;
}

/// Sign of a series just after the present moment, 0 where it vanishes within its rounding. resolution as above.
template <int N>
int sign_just_after(const Series<Rounded, N>& x, double resolution) {
  const int k = undecided(x, resolution);
  return k > N ? 0 : x[k].value > 0.0 ? 1 : -1;
}

}  // namespace wormdrive
