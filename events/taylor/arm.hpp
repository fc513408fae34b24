#pragma once
#include <array>

#include "core/numbers/pair.hpp"
#include "core/numbers/sine_cosine.hpp"
#include "events/taylor/polynomial.hpp"

namespace wormdrive {

/// Cosine and sine of an angle that moves, as power series side by side.
class ArmSeries {
 public:
  void begin(const SineAndCosine& now) { c_[0] = Pair{now.cosine, now.sine}; }
  double cosine(int k) const { return c_[k][0]; }

  /// Coefficient k of cosine and sine: k cos_k = -sum of omega_(j-1) sin_(k-j), k sin_k = sum of omega_(j-1) cos_(k-j).
  /// Summed from the middle outwards: the factors that are known last come last, and two sums run side by side.
  [[gnu::always_inline]] void turn(const Coefficients& omega, int k) {
    Pair lower{0.0, 0.0}, upper{0.0, 0.0};
    if (k % 2 == 1) lower = omega[k / 2] * c_[k / 2];
    for (int j = k / 2; j >= 1; --j) {
      lower += omega[j - 1] * c_[k - j];
      upper += omega[k - j] * c_[j - 1];
    }
    const Pair sum = (lower + upper) * reciprocal[k];
    c_[k] = Pair{-sum[1], sum[0]};
  }

 private:
  std::array<Pair, highest_order + 2> c_{};
};

}  // namespace wormdrive
