#pragma once
#include <array>

#include "core/numbers/lanes.hpp"
#include "core/numbers/sine_cosine.hpp"
#include "events/taylor/polynomial.hpp"

namespace wormdrive {

/// Cosine and sine of an angle that moves, as power series side by side, of one drive or of several at once.
template <class V, int size = highest_order + 2>
class ArmSeriesOf {
 public:
  void begin(const SineAndCosineOf<V>& now) { c_[0] = Both<V>{now.cosine, now.sine}; }
  V cosine(int k) const { return c_[k][0]; }

  /// Coefficient k of cosine and sine: k cos_k = -sum of omega_(j-1) sin_(k-j), k sin_k = sum of omega_(j-1) cos_(k-j).
  /// Summed from the middle outwards: the factors that are known last come last, and two sums run side by side.
  template <class Coefficients>
  [[gnu::always_inline]] void turn(const Coefficients& omega, int k) {
    Both<V> lower{V(0.0), V(0.0)}, upper{V(0.0), V(0.0)};
    if (k % 2 == 1) lower = omega[k / 2] * c_[k / 2];
    for (int j = k / 2; j >= 1; --j) {
      lower += omega[j - 1] * c_[k - j];
      upper += omega[k - j] * c_[j - 1];
    }
    const Both<V> sum = V(one_over(k)) * (lower + upper);
    c_[k] = Both<V>{-sum[1], sum[0]};
  }

 private:
  std::array<Both<V>, size> c_;
};
using ArmSeries = ArmSeriesOf<double>;

}  // namespace wormdrive
