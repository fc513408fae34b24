#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace wormdrive {

inline constexpr int highest_order = 24;  ///< of a power series of the speed

/// One power series in the time since a step began.
using Coefficients = std::array<double, highest_order + 2>;

/// Coefficients c[0], c[1], ... of the polynomial c[0] + c[1] s + ... in the time s since a step began.
using Polynomial = std::span<const double>;

/// The value at s, by Horner's rule on the even and the odd powers.
inline double value(Polynomial c, double s) {
  const double square = s * s;
  double even = 0.0, odd = 0.0;
  auto k = c.size();
  if (k % 2 == 1) even = c[--k];
  while (k > 0) {
    odd = odd * square + c[--k];
    even = even * square + c[--k];
  }
  return even + s * odd;
}

/// Proof that a polynomial has no root in [0, h]: nothing it can lose outweighs what it has at 0. It may fail where
/// there is no root either.
inline bool stays_positive(Polynomial c, double h) {
  double low = c[0], power = h;
  for (std::size_t k = 1; k < c.size(); ++k, power *= h) low += std::min(c[k], 0.0) * power;
  return low > 1e-12 * c[0];  // far above rounding, so that the next step begins positive as well
}

}  // namespace wormdrive
