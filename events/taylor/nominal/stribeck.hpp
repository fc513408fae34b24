#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "core/numbers/exponential.hpp"
#include "events/taylor/nominal/arm.hpp"
#include "events/taylor/nominal/leap.hpp"

namespace wormdrive {

/// How friction between the teeth falls with the sliding speed v in one mode, of one drive or of several at once that
/// have exponent and tail in common.
///
/// Friction is mu = least + drop e with e = exp(-x^p) or 1/(1 + x^p), x = |v|/speed. Inertia and torques of a mode,
/// multiplied by the gear's lever arm, are linear in mu, and so
///   theta'' = [theta'' with the least friction] + pull u beyond,  u = e/(1 + bend e),
/// where beyond is the distance from the switching surface, in which there is no friction of the teeth. With
/// u' = -(x^p)' (u - bend u^2) or -(x^p)' u^2 every coefficient of a series follows from those before it.
template <class V>
struct FallOf {
  V pull, bend;
  V per_speed, speed;  ///< x of a speed of the gear, and the speed where x is 1
  int exponent;        ///< p
  bool has_tail;

  V power(const V& x) const {
    const V square = x * x;
    return exponent == 1 ? x : exponent == 2 ? square : exponent == 3 ? square * x : square * square;
  }
  /// x^(p-1).
  V below_power(const V& x) const {
    return exponent == 1 ? V(1.0) : exponent == 2 ? x : exponent == 3 ? x * x : x * x * x;
  }
  /// How much of the drop is left, e(x^p).
  V left(const V& to_power) const {
    if (has_tail) return 1.0 / (1.0 + to_power);
    return decay(to_power);
  }
};

/// Power series of what the fall of friction adds to a motion.
template <class V, int size>
class FallSeriesOf {
 public:
  /// Begins at a speed; time_unit [s] is that of the coefficients.
  template <class H = double>
  void begin(const FallOf<V>& fall, const V& motion, const V& omega, const H& time_unit = 1.0) {
    fall_ = fall;
    scale_ = motion * fall.per_speed / time_unit;
    const V x = fall.per_speed * (motion * omega), e = fall.left(fall.power(x));
    x_[0] = x;
    square_[0] = x * x;
    u_[0] = e / (1.0 + fall.bend * e);
    rest_[0] = rest(u_[0], u_[0] * u_[0]);
  }
  /// Coefficient k of what is added to theta'', where k of speed and distance are known, taken in order.
  template <class Coefficients>
  [[gnu::always_inline]] V term(int k, const Coefficients& omega, const V& beyond) {
    beyond_[k] = beyond;
    if (k > 0) {
      x_[k] = scale_ * omega[k];
      raise(k);
      V falls = 0.0;
      for (int j = 1; j <= k; ++j) falls += slope_[j] * rest_[k - j];
      u_[k] = -falls * one_over(k);
      V square = u_[k] * u_[0];
      square += square;
      for (int j = 1; j < k; ++j) square += u_[j] * u_[k - j];
      rest_[k] = rest(u_[k], square);
    }
    V sum = 0.0;
    for (int j = 0; j <= k; ++j) sum += beyond_[j] * u_[k - j];
    return fall_.pull * sum;
  }
  /// Whether a series of this order can be judged by its last terms over a step of h. Far above its speed the fall is
  /// flat, and terms too small to be seen would hide the friction that returns as the drive slows down.
  bool holds(int order, double h) const {
    double slower = 0.0;
    for (int k = order - 1; k >= 1; --k) slower = (slower + std::abs(x_[k])) * h;
    const double highest = fall_.power(x_[0]), lowest = fall_.power(std::max(x_[0] - slower, 0.0));
    if (fall_.has_tail) {
      constexpr double flat = 1e20, most_growth = 64.0;
      return lowest >= flat || 1.0 + highest <= most_growth * (1.0 + lowest);
    }
    constexpr double flat = 45.0;  // e^-45 is nothing in a double
    return lowest >= flat || highest - lowest <= 0.5 * order;
  }

 private:
  /// The rate of u over that of -x^p.
  V rest(const V& u, const V& square) const { return fall_.has_tail ? square : u - fall_.bend * square; }
  /// Coefficient k of the rate of x^p, times k.
  [[gnu::always_inline]] void raise(int k) {
    V raised = x_[k];
    if (fall_.exponent > 1) {
      square_[k] = product(k, x_, x_);
      if (fall_.exponent == 2)
        raised = square_[k];
      else
        raised = product(k, square_, fall_.exponent == 3 ? x_ : square_);
    }
    slope_[k] = static_cast<double>(k) * raised;
  }
  using Coefficients = std::array<V, size>;
  [[gnu::always_inline]] static V product(int k, const Coefficients& a, const Coefficients& b) {
    V sum = 0.0;
    for (int j = 0; j <= k; ++j) sum += a[j] * b[k - j];
    return sum;
  }

  FallOf<V> fall_{};
  V scale_{};
  Coefficients x_, square_, slope_, u_, rest_, beyond_;  ///< rest: u - bend u^2, slope: k (x^p)_k
};

/// A step under constant torques while friction falls.
template <class V>
class FallingLeap {
  using Mask = MaskOf<V>;

 public:
  /// Moves angle and speed on by h, if it is certain beforehand that no guard falls through zero in it and how far the
  /// series must go, and returns where it is. Elsewhere nothing has changed.
  template <bool swings, class H>
  [[gnu::always_inline]] static Mask take(const HeldMotionOf<V>& m, const FallOf<V>& fall, V& theta, V& omega,
                                          const H& h, const HeldTorquesOf<V>& held, const SineAndCosineOf<V>& arm,
                                          const TaylorAccuracy& accuracy) {
    const TermsOf<V> terms = foresee(m, fall, omega, h, held, arm, accuracy);
    if (terms.most == 0) return terms.suffice;

    // Coefficients in the time in which the step takes 1, speeds as angles per step.
    FallSeriesOf<V, longest + 1> series;
    ArmSeriesOf<V, longest + 1> turning;
    std::array<V, longest + 1> speed;
    series.begin(fall, m.motion, omega, h);
    V push = held.push, beyond = held.beyond, angle = omega * h, change = 0.0;
    const H square = h * h;
    const V drag = m.drag * h, skew = m.skew / h;
    turning.begin(arm);
    speed[0] = angle;
#pragma GCC unroll 16
    for (int k = 0; k < longest; ++k) {
      if (k == terms.most) break;
      if constexpr (swings) {
        if (k > 0) turning.turn(speed, k);
        push += m.gravity * turning.cosine(k);
        beyond = beyond - m.lift * turning.cosine(k);
      }
      const V alpha = square * (push + series.term(k, speed, beyond - skew * speed[k])) - drag * speed[k];
      speed[k + 1] = alpha * one_over(k + 1);
      if constexpr (std::is_same_v<V, double>) {
        change += speed[k + 1];
        angle += speed[k + 1] * one_over(k + 2);
      } else {  // a drive alone would have stopped there
        const Mask counts = V(static_cast<double>(k)) < terms.of_each;
        change = select(counts, change + speed[k + 1], change);
        angle = select(counts, angle + speed[k + 1] * one_over(k + 2), angle);
      }
      push = beyond = 0.0;
    }
    theta = select(terms.suffice, theta + angle, theta);
    omega = select(terms.suffice, omega + change / h, omega);
    return terms.suffice;
  }

 private:
  static constexpr int longest = 12;  ///< coefficients of the acceleration

  /// How many coefficients of the acceleration a step needs. Bounds hold for complex times up to a radius within which
  /// |e| stays bounded, and so does the acceleration; by Cauchy's estimate its k-th coefficient is at most that bound
  /// over the radius^k.
  template <class H>
  [[gnu::always_inline]] static TermsOf<V> foresee(const HeldMotionOf<V>& m, const FallOf<V>& fall, const V& omega,
                                                   const H& h, const HeldTorquesOf<V>& held,
                                                   const SineAndCosineOf<V>& arm, const TaylorAccuracy& accuracy) {
    const V x = fall.per_speed * (m.motion * omega), e = fall.left(fall.power(x));
    const Disc d = fall.has_tail ? disc_with_tail(fall, x, e) : disc_without_tail(fall, x, e);
    const V bent = abs(fall.bend) * d.highest;
    Mask certain = (x >= V(0.0)) & (bent <= V(0.5));

    constexpr double cosh_1 = 1.544;
    const V v = abs(omega), rise = d.aside * fall.speed, fastest = v + rise;  // speeds within the radius
    const V beyond = abs(held.beyond) + cosh_1 * abs(m.lift) + abs(m.skew) * fastest;
    const V uneven =
        cosh_1 * abs(m.gravity) + abs(m.drag) * fastest + abs(fall.pull) * (d.highest / (1.0 - bent)) * beyond;
    const V alpha = (abs(held.push) + uneven) * above_one;
    const V ratio = h * greatest<V>(alpha / rise, fastest);  // of the step to the radius
    const V change = alpha * h;
    const V distance = held.beyond - m.lift * arm.cosine - m.skew * omega;
    const V nearing = abs(m.lift) * ((v + change) * h) + abs(m.skew) * change;
    const Mask without_teeth = !(m.flank != V(0.0));
    certain =
        certain & (ratio <= V(0.5)) & (m.motion * omega > change) & (without_teeth | (-m.flank * distance > nearing));

    const V allowed = accuracy.allowed(v + change, h) * (1.0 - ratio);
    return TermsOf<V>::needed(certain, 2, longest, uneven * (ratio * ratio), ratio, allowed);
  }

  /// A distance from x in the complex plane, and the most that |e| comes to within it.
  struct Disc {
    V aside, highest;
  };
  /// exp(-x^p) where x^p changes by at most `far`, or has no negative real part.
  static Disc disc_without_tail(const FallOf<V>& fall, const V& x, const V& e) {
    constexpr double far = 3.0, exp_far = 20.1;
    constexpr std::array<double, 5> nowhere_negative{0.0, 0.999, 0.707, 0.499, 0.382};  // sin(pi/(2p))
    constexpr std::array<double, 5> root_of_far{0.0, 3.0, 1.733, 1.443, 1.317};
    const auto p = static_cast<std::size_t>(fall.exponent);
    // (x + r)^p - x^p <= p r (x + root of far)^(p-1)
    const V aside = far / (static_cast<double>(fall.exponent) * fall.below_power(x + root_of_far[p]));
    const V wide = nowhere_negative[p] * x;
    const Mask is_wide = wide > aside;
    return {select(is_wide, wide, aside), select(is_wide, V(1.0), e * exp_far)};
  }
  /// 1/(1 + x^p) where x^p changes by at most half of 1 + x^p: the distance is less than max(0.8, x/2) where p > 1.
  static Disc disc_with_tail(const FallOf<V>& fall, const V& x, const V& e) {
    const V most = fall.below_power(x + greatest<V>(V(0.8), 0.5 * x));
    return {0.5 / (e * static_cast<double>(fall.exponent) * most), 2.0 * e};
  }
};

}  // namespace wormdrive
