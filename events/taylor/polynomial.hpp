#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "core/numbers/pair.hpp"
#include "core/numbers/series.hpp"

namespace wormdrive {

inline constexpr int highest_order = highest_series - 1;  ///< of a power series of the speed

/// One power series in the time since a step began.
using Coefficients = std::array<double, highest_order + 2>;

/// 1/k.
inline constexpr auto reciprocal = [] {
  std::array<double, highest_order + 3> r{};
  for (std::size_t k = 1; k < r.size(); ++k) r[k] = 1.0 / static_cast<double>(k);
  return r;
}();

/// The same where no table may be: in kernels of lanes, whose symbols nobody else sees.
[[gnu::always_inline]] inline double one_over(int k) { return 1.0 / static_cast<double>(k); }

/// x h^n.
template <class V>
[[gnu::always_inline]] inline V times_power(V x, V h, int n) {
  for (; n > 0; n /= 2, h = h * h)
    if (n % 2 == 1) x = x * h;
  return x;
}

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

/// What a polynomial can lose on [0, h] by its terms from the square on.
inline double possible_loss(Polynomial c, double h) {
  const double square = h * h;
  Pair loss{0.0, 0.0}, power{square, h * square};
  std::size_t k = 2;
  for (; k + 1 < c.size(); k += 2, power *= square) {
    const Pair term = pair_at(&c[k]);
    loss += (term < 0.0 ? term : Pair{0.0, 0.0}) * power;
  }
  if (k < c.size()) loss[0] += std::min(c[k], 0.0) * power[0];
  return -(loss[0] + loss[1]);
}

/// Far above rounding: what is more than this share of its start at the end of a step begins the next one positive.
inline constexpr double share_left = 1e-12;

/// Proof that a polynomial has no root in [0, h]: nothing it can lose outweighs what it has at 0. It may fail where
/// there is no root either.
inline bool stays_positive(Polynomial c, double h) {
  const double rate = c.size() > 1 ? std::min(c[1], 0.0) : 0.0;
  return c[0] + rate * h - possible_loss(c, h) > share_left * c[0];
}

}  // namespace wormdrive
