#pragma once
#include "core/numbers/exponential.hpp"

namespace wormdrive {

/// What decays as e^(-s) over a step from 0 to x >= 0: what is left of it, and its repeated integrals; of one number or
/// of several at once.
template <class V>
struct DecayOf {
  static constexpr int last = 5;

  [[gnu::always_inline]] const V& left() const { return integrals[0]; }

  V integrals[last + 1];  ///< the k-th divided by x^k, which is 1/k! where x is 0; that of number 0 is what is left

  [[gnu::always_inline]] explicit DecayOf(const V& x) {
    integrals[0] = decay(x);
    // Where much has decayed the recursion loses no digits upwards, elsewhere it loses none downwards.
    const MaskOf<V> is_short = x < V(1.0);
    upwards(1.0 / x);
    if (any(is_short)) downwards(x, is_short);
  }

 private:
  [[gnu::always_inline]] void upwards(const V& per_x) {
    for (int k = 1; k <= last; ++k) integrals[k] = (one_over_factorial[k - 1] - integrals[k - 1]) * per_x;
  }
  [[gnu::always_inline]] void downwards(const V& x, const MaskOf<V>& which) {
    // the last one by its series, even and odd powers side by side
    constexpr int terms = 14;  // x^14/19! is less than rounding
    const V square = x * x;
    V even = one_over_factorial[last + terms - 2], odd = one_over_factorial[last + terms - 1];
    for (int k = terms - 4; k >= 0; k -= 2) {
      even = even * square + one_over_factorial[last + k];
      odd = odd * square + one_over_factorial[last + k + 1];
    }
    V above = even - x * odd;
    for (int k = last;; --k) {
      integrals[k] = select(which, above, integrals[k]);
      if (k == 1) break;
      above = one_over_factorial[k - 1] - x * above;
    }
  }

  static constexpr double one_over_factorial[] = {1.0,
                                                  1.0,
                                                  1.0 / 2,
                                                  1.0 / 6,
                                                  1.0 / 24,
                                                  1.0 / 120,
                                                  1.0 / 720,
                                                  1.0 / 5040,
                                                  1.0 / 40320,
                                                  1.0 / 362880,
                                                  1.0 / 3628800,
                                                  1.0 / 39916800,
                                                  1.0 / 479001600,
                                                  1.0 / 6227020800,
                                                  1.0 / 87178291200,
                                                  1.0 / 1307674368000,
                                                  1.0 / 20922789888000,
                                                  1.0 / 355687428096000,
                                                  1.0 / 6402373705728000};
};

/// Coefficients of such a rest from the first on, where so much is left of it and it decays with a time constant.
template <class V>
[[gnu::always_inline]] inline void expand_decay(const V& left, const V& lag, int order, V* c) {
  const V rate = -1.0 / lag;
  V term = left;
  for (int k = 1; k <= order; ++k) c[k] = term = term * rate * (1.0 / static_cast<double>(k));
}

}  // namespace wormdrive
