#pragma once
#include <array>
#include <cmath>
#include <type_traits>

#include "core/numbers/decay.hpp"
#include "core/numbers/sine_cosine.hpp"
#include "events/taylor/accuracy.hpp"
#include "events/taylor/nominal/bounds.hpp"
#include "events/taylor/terms.hpp"

namespace wormdrive {

/// What constant torques do to a drive: its acceleration and its distance from the switching surface, without what
/// arm and bearings add.
template <class V>
struct HeldTorquesOf {
  V push, beyond;

  [[gnu::always_inline]] friend HeldTorquesOf operator+(const HeldTorquesOf& a, const HeldTorquesOf& b) {
    return {a.push + b.push, a.beyond + b.beyond};
  }
};
using HeldTorques = HeldTorquesOf<double>;

/// What is left of the torque before, of a motor that follows its command with a lag: what it adds to both where a step
/// begins, and how it decays over the step.
template <class V>
struct LaggingTorqueOf {
  HeldTorquesOf<V> left;
  DecayOf<V> decay;
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
    return clear_of_surface(omega, held, arm, -flank);
  }
  /// Whether the other flank certainly carries under them.
  [[gnu::always_inline]] Mask changes_flank(const V& omega, const HeldTorquesOf<V>& held,
                                            const SineAndCosineOf<V>& arm) const {
    return clear_of_surface(omega, held, arm, flank);
  }

  /// Moves angle and speed on by h in one step, if it is certain beforehand that no guard falls through zero in it and
  /// how far the series must go, and returns where it is. Elsewhere nothing has changed. rubs: drag or skew is not 0;
  /// H: double, or V where lanes have steps of their own.
  template <bool swings, bool rubs, class H>
  [[gnu::always_inline]] Mask leap(V& theta, V& omega, const H& h, const HeldTorquesOf<V>& held,
                                   const SineAndCosineOf<V>& arm, const TaylorAccuracy& accuracy) const {
    const Foresight f = foresee<rubs>(omega, h, held, arm, accuracy, nullptr);
    const Mask left = take<swings, rubs>(f, theta, omega, h, held.push, arm);
    if constexpr (rubs)
      if (any(left)) return f.certain & !leap_by_disc<swings>(left, theta, omega, h, held.push, arm, f.allowed);
    return f.certain & !left;
  }
  /// The same without drag while a torque decays.
  template <bool swings, class H>
  [[gnu::always_inline]] Mask leap(V& theta, V& omega, const H& h, const HeldTorquesOf<V>& held,
                                   const LaggingTorqueOf<V>& lagging, const SineAndCosineOf<V>& arm,
                                   const TaylorAccuracy& accuracy) const {
    const Foresight f = foresee<false>(omega, h, held, arm, accuracy, &lagging.left);
    const V speed = omega;
    const Mask known = f.certain & !take<swings, false>(f, theta, omega, h, held.push, arm);
    // The motion under what stays is known. What decays adds y, y'' = left e^(-s/lag) - gravity sin(arm) y; there the
    // arm is followed to first order, see foresee().
    const V(&integrals)[DecayOf<V>::last + 1] = lagging.decay.integrals;
    V angle = integrals[2], change = integrals[1];
    if constexpr (swings) {
      const V tilt = gravity * arm.sine * (h * h), turning = gravity * arm.cosine * (h * h) * (speed * h);
      angle = angle - (tilt * integrals[4] + turning * (integrals[4] - 2.0 * integrals[5]));
      change = change - (tilt * integrals[3] + turning * (integrals[3] - integrals[4]));
    }
    theta = select(known, theta + lagging.left.push * (h * h) * angle, theta);
    omega = select(known, omega + lagging.left.push * h * change, omega);
    return known;
  }

 private:
  static constexpr int longest = 9, longest_by_disc = 12;

  /// Whether a moving drive is clear of the switching surface on a side of it.
  [[gnu::always_inline]] Mask clear_of_surface(const V& omega, const HeldTorquesOf<V>& held,
                                               const SineAndCosineOf<V>& arm, const V& side) const {
    const V rubbing = skew * omega, distance = held.beyond - lift * arm.cosine - rubbing;
    return (motion * omega > 0.0) & (side * distance > 1e-3 * (abs(lift) + abs(rubbing)));
  }

  /// What is known of a step beforehand: whether no guard falls through zero, and what decides how many derivatives it
  /// needs. error, reach and allowed are squares, for a root would keep everything behind it waiting.
  struct Foresight {
    Mask certain;
    V error, reach, allowed;
  };
  /// decaying: what a torque that decays adds where the step begins; nullptr without one.
  template <bool rubs, class H, class Decaying>
  [[gnu::always_inline]] Foresight foresee(const V& omega, const H& h, const HeldTorquesOf<V>& held,
                                           const SineAndCosineOf<V>& arm, const TaylorAccuracy& accuracy,
                                           const Decaying& decaying) const {
    constexpr bool decays = !std::is_null_pointer_v<Decaying>;
    // Bounds of acceleration and speed within the step; friction cannot raise either by more than (1 - drag h)^-1.
    const V v = abs(omega), pull = abs(gravity), damping = abs(drag);
    V alpha = abs(held.push) + pull;
    if constexpr (rubs) {
      // what drag and the other torques leave of each other changes with the load alone
      const V now = abs(held.push + gravity * arm.cosine - drag * omega) + 2.0 * pull;
      alpha = least<V>(alpha + damping * v, now) * (1.0 + 2.0 * damping * h);
    }
    if constexpr (decays) alpha = alpha + abs(decaying->push);
    alpha = alpha * above_one;
    const V change = alpha * h, fastest = v + change;
    // The speed keeps its sign if it is large enough, or if nothing can turn the acceleration against it.
    const V along = motion * omega, against = rubs ? pull + damping * fastest : pull;
    Mask pushed = motion * held.push > against * above_one;
    if constexpr (decays) pushed = pushed & (motion * (held.push + decaying->push) > against * above_one);
    Mask certain = (along > change) | ((along >= 0.0) & pushed);
    if constexpr (rubs) certain = certain & (damping * h <= 0.5);
    V distance = held.beyond - lift * arm.cosine, nearing = abs(lift) * (fastest * h);
    if constexpr (rubs) {
      distance = distance - skew * omega;
      nearing = nearing + abs(skew) * change;
    }
    const Mask without_teeth = !(flank != 0.0);
    Mask keeps_flank = -flank * distance > nearing;
    if constexpr (decays) keeps_flank = keeps_flank & (-flank * (distance + decaying->beyond) > nearing);
    certain = certain & (without_teeth | keeps_flank);
    V rate = fastest * fastest + alpha, restoring = pull;  // rate: sigma^2
    if constexpr (rubs) {
      rate = rate + damping * damping;
      restoring = restoring + damping * root(rate);
    }
    const V reach = rate * (h * h), error = restoring * restoring * (reach * reach * reach);
    V allowed = accuracy.allowed(fastest, h);
    if constexpr (decays) {
      // Of y'' is left out gravity [(rate s^2/2) (|left| s^2/2) + gravity |left| s^4/22 + y^2/2], |y| <= 0.543 |left|
      // s^2, and alpha is more than gravity and |left| together.
      const V left_out = 0.09 * pull * abs(decaying->push) * (reach * (h * h));
      certain = certain & (pull * (h * h) <= 1.0) & (left_out < allowed);
      allowed = allowed - left_out;
    }
    return {certain, error, reach, allowed * allowed};
  }

  /// Takes the step where that is enough; returns where it takes more than the longest series.
  template <bool swings, bool rubs, class H>
  [[gnu::always_inline]] Mask take(const Foresight& f, V& theta, V& omega, const H& h, const V& push,
                                   const SineAndCosineOf<V>& arm) const {
    Mask left = f.certain;
    if constexpr (!rubs) {
      constexpr double remainder = motion_bounds.remainder(5);
      const Mask enough = f.error * f.reach * (remainder * remainder) <= f.allowed, closed = left & enough;
      if (any(closed)) {
        V angle = theta, speed = omega;
        fifth_order<swings>(angle, speed, h, push, arm);
        theta = select(closed, angle, theta);
        omega = select(closed, speed, omega);
      }
      left = left & !enough;
    }
    if (any(left)) [[unlikely]]
      left = follow<4, swings, rubs, false>(left, theta, omega, h, push, arm, f);
    return left;
  }
  /// The same with drag, where the bounds above are too coarse: drag alone has no more of a derivative than the one
  /// before, while they grow as factorials. Within a disc of complex times in which the angle changes by less than 1
  /// the acceleration is at most (|theta''| + 1.55 gravity) e^(drag radius); Cauchy's estimate bounds its coefficients.
  template <bool swings, class H>
  [[gnu::noinline]] Mask leap_by_disc(const Mask& left, V& theta, V& omega, const H& h, const V& push,
                                      const SineAndCosineOf<V>& arm, const V& allowed) const {
    constexpr double lengths = 3.0, growth = 20.1;  // of the decay in the disc, and e^3
    const V v = abs(omega), alpha = growth * (abs(push + gravity * arm.cosine - drag * omega) + 1.55 * abs(gravity));
    const V radius = least<V>(lengths / abs(drag), 2.0 / (v + root(v * v + 4.0 * alpha)));
    const V ratio = above_one * h / radius, square = ratio * ratio, rest = 1.0 - ratio;
    const Mask is_within = ratio < 0.5;
    if (!any(left & is_within)) return left;
    const V fifth = square * square * ratio;
    const Mask open =
        follow<6, swings, true, true>(left & is_within, theta, omega, h, push, arm,
                                      {left, alpha * alpha * (fifth * fifth), square, allowed * (rest * rest)});
    return open | (left & !is_within);
  }

  /// The step to the fifth derivative of the angle without drag, in closed form. It is linear in the acceleration, and
  /// all that multiplies it and is added to it is known before the torque is: nothing else waits for a controller.
  template <bool swings, class H>
  [[gnu::always_inline]] void fifth_order(V& theta, V& omega, const H& h, const V& push,
                                          const SineAndCosineOf<V>& arm) const {
    if constexpr (!swings) {
      theta += omega * h + 0.5 * push * (h * h);
      omega += push * h;
    } else {
      const H square = h * h;
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
  /// returned, nothing changes. by_disc: of the acceleration each falls by the ratio.
  template <int N, bool swings, bool rubs, bool by_disc, class H>
  Mask follow(Mask left, V& theta, V& omega, const H& h, const V& push, const SineAndCosineOf<V>& arm,
              const Foresight& f) const {
    constexpr double remainder = by_disc ? 1.0 / N : motion_bounds.remainder(N);
    const Mask enough = f.error * (remainder * remainder) <= f.allowed, taken = left & enough;
    if (any(taken)) {
      V angle = theta, speed = omega;
      step<N, swings, rubs>(angle, speed, h, push, arm);
      theta = select(taken, angle, theta);
      omega = select(taken, speed, omega);
    }
    left = left & !enough;
    if constexpr (N < (by_disc ? longest_by_disc : longest))
      if (any(left))
        return follow<N + 1, swings, rubs, by_disc>(left, theta, omega, h, push, arm,
                                                    {f.certain, f.error * f.reach, f.reach, f.allowed});
    return left;
  }

  /// The step with the derivatives of the angle up to the N-th.
  template <int N, bool swings, bool rubs, class H>
  void step(V& theta, V& omega, const H& h, const V& push, const SineAndCosineOf<V>& arm) const {
    // Derivatives of the angle and of the arm's height and reach, in the time in which the step takes 1.
    std::array<V, N + 1> x;
    std::array<V, N> cosine, sine;
    const H square = h * h;
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

}  // namespace wormdrive
