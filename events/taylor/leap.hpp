#pragma once
#include <array>
#include <cmath>

#include "core/numbers/sine_cosine.hpp"
#include "events/taylor/accuracy.hpp"
#include "events/taylor/bounds.hpp"

namespace wormdrive {

/// What constant torques do to a drive: its acceleration and its distance from the switching surface, without what
/// arm and bearings add.
template <class V>
struct HeldTorquesOf {
  V push, beyond;
};
using HeldTorques = HeldTorquesOf<double>;

inline constexpr double above_one = 1.000001;  ///< what rounding could add to a bound

/// How many coefficients of an acceleration a step needs, of one drive or of several at once, and the most of all.
template <class V>
struct TermsOf {
  V of_each;
  int most = 0;
  MaskOf<V> suffice;  ///< where that many do

  /// Among some, where `fewest` leave an error of the acceleration that falls by a ratio with each one more.
  [[gnu::always_inline]] static TermsOf needed(const MaskOf<V>& among, int fewest, int longest, V error, const V& ratio,
                                               const V& allowed) {
    TermsOf terms{V(0.0), 0, among};
    MaskOf<V> left = among;
    for (int n = fewest; n <= longest && any(left); ++n, error = error * ratio) {
      const MaskOf<V> enough = left & (error * one_over(n + 1) <= allowed);
      if (!any(enough)) continue;
      terms.of_each = select(enough, V(static_cast<double>(n)), terms.of_each);
      terms.most = n;
      left = left & !enough;
    }
    terms.suffice = among & !left;
    return terms;
  }
};

/// A drive in one of its moving modes under constant torques: theta'' = push + gravity cos(arm) - drag theta', and the
/// distance from the switching surface is beyond - lift cos(arm) - skew theta', where arm is the angle of a gravity
/// load's arm, theta plus a constant. All in SI, of one drive or of several at once.
template <class V>
struct HeldMotionOf {
  using Mask = MaskOf<V>;

  V motion, flank;  ///< +1, -1 or (flank) 0
  V gravity, drag;
  V lift, skew;

  /// Whether the mode certainly goes on under new torques: they are clear of the switching surface.
  [[gnu::always_inline]] Mask goes_on(const V& omega, const HeldTorquesOf<V>& held,
                                      const SineAndCosineOf<V>& arm) const {
    const V rubbing = skew * omega, distance = held.beyond - lift * arm.cosine - rubbing;
    return (motion * omega > 0.0) & (-flank * distance > 1e-3 * (abs(lift) + abs(rubbing)));
  }

  /// Moves angle and speed on by h in one step, if it is certain beforehand that no guard falls through zero in it and
  /// how far the series must go, and returns where it is. Elsewhere nothing has changed. rubs: drag or skew is not 0.
  template <bool swings, bool rubs>
  [[gnu::always_inline]] Mask leap(V& theta, V& omega, double h, const HeldTorquesOf<V>& held,
                                   const SineAndCosineOf<V>& arm, const TaylorAccuracy& accuracy) const {
    const Foresight f = foresee<rubs>(omega, h, held, arm, accuracy);
    Mask left = f.certain;
    if constexpr (!rubs) {
      constexpr double remainder = motion_bounds.remainder(5);
      const Mask enough = f.error * f.reach * (remainder * remainder) <= f.allowed, closed = left & enough;
      if (any(closed)) {
        V angle = theta, speed = omega;
        fifth_order<swings>(angle, speed, h, held.push, arm);
        theta = select(closed, angle, theta);
        omega = select(closed, speed, omega);
      }
      left = left & !enough;
    }
    if (any(left)) [[unlikely]]
      left = follow<4, swings, rubs>(left, theta, omega, h, held.push, arm, f);
    return f.certain & !left;
  }

 private:
  static constexpr int longest = 9;

  /// What is known of a step beforehand: whether no guard falls through zero, and what decides how many derivatives it
  /// needs. error, reach and allowed are squares, for a root would keep everything behind it waiting.
  struct Foresight {
    Mask certain;
    V error, reach, allowed;
  };
  template <bool rubs>
  [[gnu::always_inline]] Foresight foresee(const V& omega, double h, const HeldTorquesOf<V>& held,
                                           const SineAndCosineOf<V>& arm, const TaylorAccuracy& accuracy) const {
    // Bounds of acceleration and speed within the step; friction cannot raise either by more than (1 - drag h)^-1.
    const V v = abs(omega), pull = abs(gravity), damping = abs(drag);
    V alpha = abs(held.push) + pull;
    if constexpr (rubs) alpha = (alpha + damping * v) * (1.0 + 2.0 * damping * h);
    alpha = alpha * above_one;
    const V change = alpha * h, fastest = v + change;
    // The speed keeps its sign if it is large enough, or if nothing can turn the acceleration against it.
    const V along = motion * omega, against = rubs ? pull + damping * fastest : pull;
    Mask certain = (along > change) | ((along >= 0.0) & (motion * held.push > against * above_one));
    if constexpr (rubs) certain = certain & (damping * h <= 0.5);
    V distance = held.beyond - lift * arm.cosine, nearing = abs(lift) * (fastest * h);
    if constexpr (rubs) {
      distance = distance - skew * omega;
      nearing = nearing + abs(skew) * change;
    }
    const Mask without_teeth = !(flank != 0.0);
    certain = certain & (without_teeth | (-flank * distance > nearing));
    V rate = fastest * fastest + alpha, restoring = pull;  // rate: sigma^2
    if constexpr (rubs) {
      rate = rate + damping * damping;
      restoring = restoring + damping * root(rate);
    }
    const V reach = rate * (h * h), error = restoring * restoring * (reach * reach * reach);
    const V allowed = accuracy.allowed(fastest, h);
    return {certain, error, reach, allowed * allowed};
  }

  /// The step to the fifth derivative of the angle without drag, in closed form. It is linear in the acceleration, and
  /// all that multiplies it and is added to it is known before the torque is: nothing else waits for a controller.
  template <bool swings>
  [[gnu::always_inline]] void fifth_order(V& theta, V& omega, double h, const V& push,
                                          const SineAndCosineOf<V>& arm) const {
    if constexpr (!swings) {
      theta += omega * h + 0.5 * push * (h * h);
      omega += push * h;
    } else {
      const double square = h * h;
      const V alpha = push + gravity * arm.cosine, drift = omega * h;
      const V tilt = gravity * arm.sine * square, pull = gravity * arm.cosine * square, swing = drift * drift;
      // derivatives of the angle times powers of h, without what alpha gives them
      const V third = -tilt * drift, fourth = -pull * swing, fifth = tilt * drift * (tilt + swing);
      const V turning = 3.0 * pull * drift;
      theta += (drift + (third * (1.0 / 6) + (fourth * (1.0 / 24) + fifth * (1.0 / 120)))) +
               alpha * (square * (0.5 - (tilt * (1.0 / 24) + turning * (1.0 / 120))));
      omega += (third * 0.5 + (fourth * (1.0 / 6) + fifth * (1.0 / 24))) * (1.0 / h) +
               alpha * (h * (1.0 - (tilt * (1.0 / 6) + turning * (1.0 / 24))));
    }
  }

  /// Takes the step where derivatives of the angle up to the N-th or to a later one are enough; where none is,
  /// returned, nothing changes.
  template <int N, bool swings, bool rubs>
  Mask follow(Mask left, V& theta, V& omega, double h, const V& push, const SineAndCosineOf<V>& arm,
              const Foresight& f) const {
    constexpr double remainder = motion_bounds.remainder(N);
    const Mask enough = f.error * (remainder * remainder) <= f.allowed, taken = left & enough;
    if (any(taken)) {
      V angle = theta, speed = omega;
      step<N, swings, rubs>(angle, speed, h, push, arm);
      theta = select(taken, angle, theta);
      omega = select(taken, speed, omega);
    }
    left = left & !enough;
    if constexpr (N < longest)
      if (any(left))
        return follow<N + 1, swings, rubs>(left, theta, omega, h, push, arm,
                                           {f.certain, f.error * f.reach, f.reach, f.allowed});
    return left;
  }

  /// The step with the derivatives of the angle up to the N-th.
  template <int N, bool swings, bool rubs>
  void step(V& theta, V& omega, double h, const V& push, const SineAndCosineOf<V>& arm) const {
    // Derivatives of the angle and of the arm's height and reach, in the time in which the step takes 1.
    std::array<V, N + 1> x;
    std::array<V, N> cosine, sine;
    const double square = h * h;
    cosine[0] = arm.cosine;
    sine[0] = arm.sine;
    x[1] = omega * h;
    x[2] = (push + gravity * cosine[0]) * square;
    if constexpr (rubs) x[2] = x[2] - drag * h * x[1];
    V angle = x[1] + x[2] * (1.0 / 2), speed = x[2];
    double factorial = 2.0;  // (k + 1)!
#pragma GCC unroll 16
    for (int k = 1; k + 2 <= N; ++k) {
      x[k + 2] = 0.0;
      if constexpr (swings) {
        // Leibniz's rule for cos' = -theta' sin and sin' = theta' cos; the factor that is known last comes last.
        V falls = x[k] * sine[0], rises = x[k] * cosine[0];
        double binomial = k - 1;  // k - 1 over j - 1
#pragma GCC unroll 16
        for (int j = k - 1; j >= 1; --j) {
          falls += binomial * x[j] * sine[k - j];
          rises += binomial * x[j] * cosine[k - j];
          binomial = binomial * (j - 1) / (k - j + 1);
        }
        cosine[k] = -falls;
        sine[k] = rises;
        x[k + 2] = -gravity * square * falls;
      }
      if constexpr (rubs) x[k + 2] = x[k + 2] - drag * h * x[k + 1];
      speed += x[k + 2] * (1.0 / factorial);
      factorial *= k + 2;
      angle += x[k + 2] * (1.0 / factorial);
    }
    theta += angle;
    omega += speed * (1.0 / h);
  }
};
using HeldMotion = HeldMotionOf<double>;

/// A mode under a motor's command: theta'' = per_command command + ..., what else is held included.
template <class V>
struct DrivenMotionOf {
  HeldMotionOf<V> held;
  V per_command, gain;     ///< acceleration and motor torque of a command
  V per_worm_torque;       ///< acceleration of a torque on the worm's shaft
  HeldTorquesOf<V> known;  ///< what dry friction of the bearings and other constant torques do to the drive

  /// unit_gain: the gain is 1.
  template <bool unit_gain>
  [[gnu::always_inline]] HeldTorquesOf<V> under(const V& command) const {
    return {command * per_command + known.push, (unit_gain ? command : command * gain) + known.beyond};
  }
  /// The same with a torque that disturbs the worm's shaft.
  [[gnu::always_inline]] HeldTorquesOf<V> under(const V& command, const V& disturbance) const {
    return {command * per_command + (known.push + disturbance * per_worm_torque),
            command * gain + (known.beyond + disturbance)};
  }
};
using DrivenMotion = DrivenMotionOf<double>;

}  // namespace wormdrive
