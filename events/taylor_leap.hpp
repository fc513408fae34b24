#pragma once
#include <array>
#include <cmath>

#include "core/sine_cosine.hpp"
#include "events/taylor_accuracy.hpp"
#include "events/taylor_bounds.hpp"

namespace wormdrive {

/// What constant torques do to a drive: its acceleration and its distance from the switching surface, without what
/// arm and bearings add.
struct HeldTorques {
  double push, beyond;
};

inline constexpr double above_one = 1.000001;  ///< what rounding could add to a bound

/// A drive in one of its moving modes under constant torques: theta'' = push + gravity cos(arm) - drag theta', and the
/// distance from the switching surface is beyond - lift cos(arm) - skew theta', where arm is the angle of a gravity
/// load's arm, theta plus a constant. All in SI.
struct HeldMotion {
  double motion, flank;  ///< +1, -1 or (flank) 0
  double gravity, drag;
  double lift, skew;
  bool rubs = drag != 0.0 || skew != 0.0;

  /// Moves angle and speed on by h in one step, if it is certain beforehand that no guard falls through zero in it and
  /// how far the series must go. False otherwise; then nothing has changed.
  template <bool swings>
  [[gnu::always_inline]] bool leap(double& theta, double& omega, double h, const HeldTorques& held,
                                   const SineAndCosine& arm, const TaylorAccuracy& accuracy) const {
    return rubs ? leap_with<swings, true>(theta, omega, h, held, arm, accuracy)
                : leap_with<swings, false>(theta, omega, h, held, arm, accuracy);
  }

 private:
  static constexpr int longest = 9;

  template <bool swings, bool rubs>
  [[gnu::always_inline]] bool leap_with(double& theta, double& omega, double h, const HeldTorques& held,
                                        const SineAndCosine& arm, const TaylorAccuracy& accuracy) const {
    // Bounds of acceleration and speed within the step; friction cannot raise either by more than (1 - drag h)^-1.
    const double v = std::abs(omega), pull = std::abs(gravity), damping = std::abs(drag);
    double alpha = std::abs(held.push) + pull;
    if constexpr (rubs) {
      if (!(damping * h <= 0.5)) return false;
      alpha = (alpha + damping * v) * (1.0 + 2.0 * damping * h);
    }
    alpha *= above_one;
    const double change = alpha * h, fastest = v + change;
    // The speed keeps its sign if it is large enough, or if nothing can turn the acceleration against it.
    if (!(motion * omega > change)) {
      const double against = rubs ? pull + damping * fastest : pull;
      if (!(motion * omega >= 0.0 && motion * held.push > against * above_one)) return false;
    }
    if (flank != 0.0) {
      double distance = held.beyond - lift * arm.cosine, nearing = std::abs(lift) * (fastest * h);
      if constexpr (rubs) {
        distance -= skew * omega;
        nearing += std::abs(skew) * change;
      }
      if (!(-flank * distance > nearing)) return false;
    }
    double rate = fastest * fastest + alpha, restoring = pull;  // rate: sigma^2
    if constexpr (rubs) {
      rate += damping * damping;
      restoring += damping * std::sqrt(rate);
    }
    // Squares, for a root would keep everything behind it waiting.
    const double reach = rate * (h * h), error = restoring * restoring * (reach * reach * reach);
    const double allowed = accuracy.allowed(fastest);
    if constexpr (!rubs) {
      constexpr double remainder = motion_bounds.remainder(5);
      if (error * reach * (remainder * remainder) <= allowed * allowed) {
        fifth_order<swings>(theta, omega, h, held.push, arm);
        return true;
      }
    }
    return follow<4, swings, rubs>(theta, omega, h, held.push, arm, error, reach, allowed * allowed);
  }

  /// The step to the fifth derivative of the angle without drag, in closed form. It is linear in the acceleration, and
  /// all that multiplies it and is added to it is known before the torque is: nothing else waits for a controller.
  template <bool swings>
  [[gnu::always_inline]] void fifth_order(double& theta, double& omega, double h, double push,
                                          const SineAndCosine& arm) const {
    if constexpr (!swings) {
      theta += omega * h + 0.5 * push * (h * h);
      omega += push * h;
    } else {
      const double alpha = push + gravity * arm.cosine, drift = omega * h, square = h * h;
      const double tilt = gravity * arm.sine * square, pull = gravity * arm.cosine * square, swing = drift * drift;
      // derivatives of the angle times powers of h, without what alpha gives them
      const double third = -tilt * drift, fourth = -pull * swing, fifth = tilt * drift * (tilt + swing);
      const double turning = 3.0 * pull * drift;
      theta += (drift + (third * (1.0 / 6) + (fourth * (1.0 / 24) + fifth * (1.0 / 120)))) +
               alpha * (square * (0.5 - (tilt * (1.0 / 24) + turning * (1.0 / 120))));
      omega += (third * 0.5 + (fourth * (1.0 / 6) + fifth * (1.0 / 24))) * (1.0 / h) +
               alpha * (h * (1.0 - (tilt * (1.0 / 6) + turning * (1.0 / 24))));
    }
  }

  /// The step with the derivatives of the angle up to the N-th or, if they are not enough, to a later one; error, reach
  /// and allowed are squares.
  template <int N, bool swings, bool rubs>
  bool follow(double& theta, double& omega, double h, double push, const SineAndCosine& arm, double error, double reach,
              double allowed) const {
    constexpr double remainder = motion_bounds.remainder(N);
    if (!(error * (remainder * remainder) <= allowed)) {
      if constexpr (N < longest)
        return follow<N + 1, swings, rubs>(theta, omega, h, push, arm, error * reach, reach, allowed);
      return false;
    }
    // Derivatives of the angle and of the arm's height and reach, in the time in which the step takes 1.
    std::array<double, N + 1> x;
    std::array<double, N> cosine, sine;
    const double square = h * h;
    cosine[0] = arm.cosine;
    sine[0] = arm.sine;
    x[1] = omega * h;
    x[2] = (push + gravity * cosine[0]) * square;
    if constexpr (rubs) x[2] -= drag * h * x[1];
    double angle = x[1] + x[2] * (1.0 / 2), speed = x[2], factorial = 2.0;  // (k + 1)!
#pragma GCC unroll 16
    for (int k = 1; k + 2 <= N; ++k) {
      x[k + 2] = 0.0;
      if constexpr (swings) {
        // Leibniz's rule for cos' = -theta' sin and sin' = theta' cos; the factor that is known last comes last.
        double falls = x[k] * sine[0], rises = x[k] * cosine[0], binomial = k - 1;  // k - 1 over j - 1
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
      if constexpr (rubs) x[k + 2] -= drag * h * x[k + 1];
      speed += x[k + 2] * (1.0 / factorial);
      factorial *= k + 2;
      angle += x[k + 2] * (1.0 / factorial);
    }
    theta += angle;
    omega += speed * (1.0 / h);
    return true;
  }
};

}  // namespace wormdrive
