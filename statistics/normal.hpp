#pragma once
#include <array>
#include <cmath>

#include "core/numbers/portable.hpp"

namespace wormdrive {

/// Standard deviations of half a 95 % interval of a normal number: the quantile of 0.975.
inline constexpr double normal_half_width = 1.959963984540054;

/// The z below which a standard normal number lies with probability u, 0 < u < 1 [Wichura1988, AS 241, PPND16].
inline double normal_quantile(double u) {
  using RationalTerms = std::array<double, 8>;
  const auto ratio = [](const RationalTerms& a, const RationalTerms& b, double r) {
    double above = 0.0, below = 0.0;
    for (int k = 7; k >= 0; --k) {
      above = above * r + a[k];
      below = below * r + b[k];
    }
    return above / below;
  };
  constexpr RationalTerms a{3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3,
                            1.3731693765509461125e4, 4.5921953931549871457e4, 6.7265770927008700853e4,
                            3.3430575583588128105e4, 2.5090809287301226727e3},
      b{1.0,
        4.2313330701600911252e1,
        6.8718700749205790830e2,
        5.3941960214247511077e3,
        2.1213794301586595867e4,
        3.9307895800092710610e4,
        2.8729085735721942674e4,
        5.2264952788528545610e3},
      c{1.42343711074968357734e0, 4.63033784615654529590e0,  5.76949722146069140550e0,  3.64784832476320460504e0,
        1.27045825245236838258e0, 2.41780725177450611770e-1, 2.27238449892691845833e-2, 7.74545014278341407640e-4},
      d{1.0,
        2.05319162663775882187e0,
        1.67638483018380384940e0,
        6.89767334985100004550e-1,
        1.48103976427480074590e-1,
        1.51986665636164571966e-2,
        5.47593808499534494600e-4,
        1.05075007164441684324e-9},
      e{6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,  2.96560571828504891230e-1,
        2.65321895265761230930e-2, 1.24266094738807843860e-3, 2.71155556874348757815e-5, 2.01033439929228813265e-7},
      f{1.0,
        5.99832206555887937690e-1,
        1.36929880922735805310e-1,
        1.48753612908506148525e-2,
        7.86869131145613259100e-4,
        1.84631831751005468180e-5,
        1.42151175831644588870e-7,
        2.04426310338993978564e-15};
  const double q = u - 0.5;
  if (std::abs(q) <= 0.425) return q * ratio(a, b, 0.180625 - q * q);
  const double r = std::sqrt(-portable::log(q < 0.0 ? u : 1.0 - u));
  const double z = r <= 5.0 ? ratio(c, d, r - 1.6) : ratio(e, f, r - 5.0);
  return q < 0.0 ? -z : z;
}

/// The probability below z <= 0: the quantile inverted by bisection, so that both agree to the last bits everywhere.
inline double lower_normal_probability(double z) {
  double low = 0x1p-1020, high = 0.5;
  if (normal_quantile(low) >= z) return 0.0;
  // by the exponent first: far out the probability is tiny
  while (high > 2.0 * low) {
    const double middle = std::sqrt(low) * std::sqrt(high);
    (normal_quantile(middle) < z ? low : high) = middle;
  }
  for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
    (normal_quantile(middle) < z ? low : high) = middle;
  return high;
}

/// The probability with which a standard normal number lies below z.
inline double normal_probability(double z) {
  return z <= 0.0 ? lower_normal_probability(z) : 1.0 - lower_normal_probability(-z);
}

}  // namespace wormdrive
