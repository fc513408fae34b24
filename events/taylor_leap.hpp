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

/// A drive in one of its moving modes under constant torques: theta'' = push + gravity cos(arm) - drag theta', and the
/// distance from the switching surface is beyond - lift cos(arm) - skew theta', where arm is the angle of a gravity
/// load's arm, theta plus a constant. All in SI.
struct HeldMotion {
  double motion, flank;  ///< +1, -1 or (flank) 0
  double gravity, drag;
  double lift, skew;

  /// Moves angle and speed on by h in one step, if it is certain beforehand that no guard falls through zero in it and
  /// how far the series must go. False otherwise; then nothing has changed.
  template <bool swings>
  bool leap(double& theta, double& omega, double h, const HeldTorques& held, const SineAndCosine& arm,
            const TaylorAccuracy& accuracy) const {
    return drag == 0.0 && skew == 0.0 ? HeldMotion::leap<swings, false>(theta, omega, h, held, arm, accuracy)
                                      : HeldMotion::leap<swings, true>(theta, omega, h, held, arm, accuracy);
  }

 private:
  static constexpr double above_one = 1.000001;  ///< what rounding could add to a bound
  static constexpr int longest = 9;

  template <bool swings, bool rubs>
  bool leap(double& theta, double& omega, double h, const HeldTorques& held, const SineAndCosine& arm,
            const TaylorAccuracy& accuracy) const {
    // Bounds of acceleration and speed within the step; friction cannot raise either by more than (1 - drag h)^-1.
    const double damping = rubs ? std::abs(drag) : 0.0, v = std::abs(omega), slowing = damping * h;
    const double alpha = (std::abs(held.push) + std::abs(gravity) + damping * v) * (above_one + 2.0 * slowing);
    const double change = alpha * h, fastest = v + change;
    if (!(slowing <= 0.5)) return false;
    // The speed keeps its sign if it is large enough, or if nothing can turn the acceleration against it.
    const bool fast = motion * omega > change;
    if (!fast && !(motion * omega >= 0.0 && motion * held.push > (std::abs(gravity) + damping * fastest) * above_one))
      return false;
    if (flank != 0.0) {
      const double slope = rubs ? skew : 0.0, distance = -flank * (held.beyond - lift * arm.cosine - slope * omega);
      if (!(distance > std::abs(lift) * fastest * h + std::abs(slope) * change)) return false;
    }
    const double sigma = std::sqrt(fastest * fastest + alpha + damping * damping), reach = h * sigma;
    const double error = (std::abs(gravity) + damping * sigma) * (reach * reach * reach);
    return follow<4, swings, rubs>(theta, omega, h, held.push, arm, error, reach, accuracy.allowed(fastest));
  }

  /// The step with the derivatives of the angle up to the N-th or, if they are not enough, to a later one.
  template <int N, bool swings, bool rubs>
  bool follow(double& theta, double& omega, double h, double push, const SineAndCosine& arm, double error, double reach,
              double allowed) const {
    if (!(error * motion_bounds.remainder(N) <= allowed)) {
      if constexpr (N < longest)
        return follow<N + 1, swings, rubs>(theta, omega, h, push, arm, error * reach, reach, allowed);
      return false;
    }
    std::array<double, N + 1> x;         // derivatives of the angle
    std::array<double, N> cosine, sine;  // and of the arm's height and reach
    cosine[0] = arm.cosine;
    sine[0] = arm.sine;
    x[1] = omega;
    x[2] = push + (gravity * cosine[0] - (rubs ? drag * omega : 0.0));
#pragma GCC unroll 16
    for (int k = 1; k + 2 <= N; ++k) {
      x[k + 2] = rubs ? -drag * x[k + 1] : 0.0;
      if constexpr (swings) {
        // Leibniz's rule for cos' = -theta' sin and sin' = theta' cos; the factor that is known last comes last.
        double falls = 0.0, rises = 0.0, binomial = 1.0;  // k - 1 over j - 1
#pragma GCC unroll 16
        for (int j = k; j >= 1; --j) {
          falls += binomial * x[j] * sine[k - j];
          rises += binomial * x[j] * cosine[k - j];
          binomial = binomial * (j - 1) / (k - j + 1);
        }
        cosine[k] = -falls;
        sine[k] = rises;
        x[k + 2] -= gravity * falls;
      }
    }
    double weight = h, speed = 0.0, angle = 0.0;  // h^k / k!
#pragma GCC unroll 16
    for (int k = 1; k < N; ++k) {
      speed += x[k + 1] * weight;
      weight *= h * (1.0 / (k + 1));
      angle += x[k + 1] * weight;
    }
    theta += omega * h + angle;
    omega += speed;
    return true;
  }
};

}  // namespace wormdrive
