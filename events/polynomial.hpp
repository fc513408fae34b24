#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "core/pair.hpp"

namespace wormdrive {

inline constexpr int highest_order = 24;  ///< of a power series of the speed

/// One power series in the time since a step began.
using Coefficients = std::array<double, highest_order + 2>;

/// 1/k.
inline constexpr auto reciprocal = [] {
  std::array<double, highest_order + 3> r{};
  for (std::size_t k = 1; k < r.size(); ++k) r[k] = 1.0 / static_cast<double>(k);
  return r;
}();

/// Coefficients c[0], c[1], ... of the polynomial c[0] + c[1] s + ... in the time s since a step began.
using Polynomial = std::span<const double>;

/// The value at s, by Horner's rule on the even and the odd powers.
inline double value(Polynomial c, double s) {
  const double square = s * s;
  Pair sum{0.0, 0.0};
  auto k = c.size();
  if (k % 2 == 1) sum[0] = c[--k];
  for (; k > 0; k -= 2) sum = sum * square + pair_at(&c[k - 2]);
  return sum[0] + s * sum[1];
}

/// Proof that a polynomial, with a remainder that has been left out, has no root in [0, h]: nothing it can lose
/// outweighs what it has at 0. It may fail where there is no root either.
inline bool stays_positive(Polynomial c, double h, double left_out = 0.0) {
  const double square = h * h;
  Pair loss{0.0, 0.0}, power{1.0, h};
  std::size_t k = 0;
  for (; k + 1 < c.size(); k += 2, power *= square) {
    const Pair term = pair_at(&c[k]);
    loss += (term < 0.0 ? term : Pair{0.0, 0.0}) * power;
  }
  if (k < c.size()) loss[0] += std::min(c[k], 0.0) * power[0];
  return c[0] + (loss[0] + loss[1]) - left_out >
         1e-12 * c[0];  // far above rounding, so that the next step begins positive as well
}

}  // namespace wormdrive
