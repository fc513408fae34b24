#pragma once
#include <array>
#include <limits>

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

/// Sine and cosine of an arm's angle at the latest angle of the gear. At the end of a leap they would be known as well,
/// but stand in the way of the controller, which waits for the angle and nothing else: that costs a tenth of the time
/// of a sample.
class ArmAngle {
 public:
  /// offset: of the arm against the gear [rad].
  explicit ArmAngle(double offset = 0.0) : offset_(sine_and_cosine(offset)) {}

  const SineAndCosine& offset() const { return offset_; }
  const SineAndCosine& latest() const { return now_; }
  [[gnu::always_inline]] const SineAndCosine& at(double theta_g) {
    if (theta_g != theta_g_) {
      now_ = of_sum(sine_and_cosine(theta_g), offset_);
      theta_g_ = theta_g;
    }
    return now_;
  }

 private:
  SineAndCosine offset_, now_{};
  double theta_g_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace wormdrive
