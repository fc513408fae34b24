#pragma once
#include <cmath>

#include "core/numbers/portable.hpp"

namespace wormdrive {

/// ln(1 - x), 0 <= x < 1, without loss of digits where x is small.
inline double log_of_complement(double x) {
  const double rest = 1.0 - x;
  return rest == 1.0 ? -x : portable::log(rest) * (x / (1.0 - rest));  // the error of `rest` cancels [Goldberg1991]
}

/// ln Gamma(x), x > 0, by Stirling's series.
inline double log_gamma(double x) {
  constexpr double from = 15.0;  // the first term left out is less than 1e-17 there
  double product = 1.0;
  for (; x < from; x += 1.0) product *= x;
  const double z = 1.0 / (x * x);
  const double series =
      (1.0 / 12 + z * (-1.0 / 360 + z * (1.0 / 1260 + z * (-1.0 / 1680 + z * (1.0 / 1188 - z * 691.0 / 360360))))) / x;
  constexpr double half_log_two_pi = 0.91893853320467274178;
  return (x - 0.5) * portable::log(x) - x + half_log_two_pi + series - portable::log(product);
}

/// The continued fraction of the incomplete beta function by Lentz's method [Press2007, section 6.4].
inline double beta_fraction(double a, double b, double x) {
  const auto not_zero = [](double v) { return std::abs(v) < 1e-300 ? 1e-300 : v; };
  double c = 1.0, d = 1.0 / not_zero(1.0 - (a + b) * x / (a + 1.0)), fraction = d, factor = 0.0;
  for (double m = 1.0; std::abs(factor - 1.0) > 0x1p-52; m += 1.0) {
    factor = 1.0;
    for (const double term : {m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m)),
                              -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0))}) {
      d = 1.0 / not_zero(1.0 + term * d);
      c = not_zero(1.0 + term / c);
      factor *= c * d;
    }
    fraction *= factor;
  }
  return fraction;
}

/// The number below which a beta-distributed one lies with probability u, 0 < u <= 1/2; above the median mirror it: 1
/// less the quantile of (b, a) at 1 - u. a, b > 0: the shapes. Solved for the logarithm, so that a far tail keeps its
/// digits, by bisection, so that it takes IEEE arithmetic alone.
inline double lower_beta_quantile(double a, double b, double u) {
  const double log_beta = log_gamma(a) + log_gamma(b) - log_gamma(a + b);
  const auto probability = [&](double log_x) {
    const double x = portable::exp(log_x);
    const double y = log_x > -1e-3
                         ? -log_x * (1.0 + log_x * (1.0 / 2 + log_x * (1.0 / 6 + log_x * (1.0 / 24 + log_x / 120))))
                         : 1.0 - x;
    const double log_y = log_x > -0.5 ? portable::log(y) : log_of_complement(x);
    const double front = a * log_x + b * log_y - log_beta;
    if (x < (a + 1.0) / (a + b + 2.0)) return portable::exp(front - portable::log(a)) * beta_fraction(a, b, x);
    return 1.0 - portable::exp(front - portable::log(b)) * beta_fraction(b, a, y);
  };
  double low = -1.0, high = 0.0;
  while (probability(low) > u) {
    high = low;
    low *= 2.0;
  }
  constexpr double beside_one = -0x1p-1000;  // nearer to 0 nothing more can be told from it
  for (double middle = 0.5 * (low + high); middle > low && middle < high && middle < beside_one;
       middle = 0.5 * (low + high))
    (probability(middle) < u ? low : high) = middle;
  return portable::exp(high);
}

}  // namespace wormdrive
