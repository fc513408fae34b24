#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "core/effects/stribeck.hpp"
#include "core/mesh.hpp"
#include "core/numbers/exponential.hpp"
#include "events/taylor/arm.hpp"
#include "events/taylor/leap.hpp"

namespace wormdrive {

/// Friction between the teeth that falls with the sliding speed v, in a motion that has formulas of its own.
///
/// Friction is mu = least + drop e with e = exp(-x^p) or 1/(1 + x^p), x = |v|/speed. Inertia and torques of a mode,
/// multiplied by the gear's lever arm, are linear in mu, and so
///   theta'' = [theta'' with the least friction] + pull u beyond,  u = e/(1 + bend e),
/// where beyond is the distance from the switching surface, in which there is no friction of the teeth. With
/// u' = -(x^p)' (u - bend u^2) or -(x^p)' u^2 every coefficient of a series follows from those before it.
class StribeckCurve {
 public:
  /// What the fall of friction does in one mode.
  struct Branch {
    double pull = 0.0, bend = 0.0;
  };

  StribeckCurve() = default;
  StribeckCurve(const Stribeck<double>& effect, const GearMesh<double>& mesh)
      : drop_(effect.drop),
        least_(mesh.mu - effect.drop),
        per_speed_(std::abs(mesh.sliding_speed(mesh.i)) / effect.speed),
        exponent_(static_cast<int>(std::ceil(effect.exponent))),
        has_tail_(effect.tail > 0.0) {}

  bool falls() const { return exponent_ > 0; }
  double least_friction() const { return least_; }

  /// least_mu: the lowest friction of the mode; product: its motion times flank; Jg: inertia of the gear side with the
  /// load's own.
  Branch branch(const GearMesh<double>& mesh, double least_mu, double Jg, int product) const {
    const auto inertia = [&](double mu) {
      return mesh.Jw * mesh.i * mesh.gear_arm(product * mu) + Jg * mesh.worm_arm(product * mu);
    };
    const double least = inertia(least_mu);
    return {mesh.lg * mesh.lw * portable::cos(mesh.phi_n) * product * drop_ * Jg / (least * least),
            (inertia(least_mu + drop_) - least) / least};
  }

  /// Begins the series of a motion at a speed; time_unit [s] is that of its coefficients.
  void begin(const HeldMotion& m, const Branch& branch, double omega, double time_unit = 1.0) {
    bend_ = branch.bend;
    pull_ = branch.pull;
    scale_ = m.motion * per_speed_ / time_unit;
    start(per_speed_ * (m.motion * omega));
  }
  /// Coefficient k of what the fall of friction adds to theta'', where k of speed and distance are known, taken in
  /// order.
  [[gnu::always_inline]] double term(int k, const Coefficients& omega, double beyond) {
    beyond_[k] = beyond;
    if (k > 0) {
      x_[k] = scale_ * omega[k];
      raise(k);
      double falls = 0.0;
      for (int j = 1; j <= k; ++j) falls += slope_[j] * rest_[k - j];
      u_[k] = -falls * reciprocal[k];
      double square = u_[k] * u_[0];
      square += square;
      for (int j = 1; j < k; ++j) square += u_[j] * u_[k - j];
      rest_[k] = rest(u_[k], square);
    }
    double sum = 0.0;
    for (int j = 0; j <= k; ++j) sum += beyond_[j] * u_[k - j];
    return pull_ * sum;
  }

  /// Whether a series of this order can be judged by its last terms over a step of h. Far above its speed an
  /// exponential fall is flat, and terms too small to be seen would hide the friction that returns as the drive slows
  /// down.
  bool holds(int order, double h) const {
    if (has_tail_) return true;
    constexpr double flat = 45.0;  // e^-45 is nothing in a double
    double slower = 0.0;
    for (int k = order - 1; k >= 1; --k) slower = (slower + std::abs(x_[k])) * h;
    const double lowest = power(std::max(x_[0] - slower, 0.0));
    return lowest >= flat || power(x_[0]) - lowest <= 0.5 * order;
  }

  /// Moves angle and speed on by h in one step under constant torques, if it is certain beforehand that no guard falls
  /// through zero in it and how far the series must go. False otherwise; then nothing has changed.
  template <bool swings>
  bool leap(const HeldMotion& m, const Branch& branch, double& theta, double& omega, double h, const HeldTorques& held,
            const SineAndCosine& arm, const TaylorAccuracy& accuracy) {
    const double x = per_speed_ * (m.motion * omega);
    if (!(x >= 0.0)) return false;
    const double e = left(power(x));
    const int terms = terms_over(m, branch, x, e, omega, h, held, arm, accuracy);
    if (terms == 0) return false;

    // Coefficients in the time in which the step takes 1, speeds as angles per step.
    begin(m, branch, omega, h);
    double push = held.push, beyond = held.beyond, angle = omega * h, change = 0.0;
    const double square = h * h, drag = m.drag * h, skew = m.skew / h;
    arm_.begin(arm);
    speed_[0] = angle;
#pragma GCC unroll 16
    for (int k = 0; k < longest; ++k) {
      if (k == terms) break;
      if constexpr (swings) {
        if (k > 0) arm_.turn(speed_, k);
        push += m.gravity * arm_.cosine(k);
        beyond -= m.lift * arm_.cosine(k);
      }
      const double alpha = square * (push + term(k, speed_, beyond - skew * speed_[k])) - drag * speed_[k];
      speed_[k + 1] = alpha * reciprocal[k + 1];
      change += speed_[k + 1];
      angle += speed_[k + 1] * reciprocal[k + 2];
      push = beyond = 0.0;
    }
    theta += angle;
    omega += change / h;
    return true;
  }

 private:
  static constexpr int longest = 12;  ///< coefficients of the acceleration in a leap

  double power(double x) const {
    const double square = x * x;
    return exponent_ == 1 ? x : exponent_ == 2 ? square : exponent_ == 3 ? square * x : square * square;
  }
  /// x^(p-1).
  double below_power(double x) const {
    return exponent_ == 1 ? 1.0 : exponent_ == 2 ? x : exponent_ == 3 ? x * x : x * x * x;
  }

  /// How many coefficients of the acceleration a step of h needs; 0 if a guard might fall in it, or if it takes more
  /// than there are.
  ///
  /// Bounds hold for complex times up to a radius within which |e| stays bounded, and so does the acceleration; by
  /// Cauchy's estimate its k-th coefficient is at most that bound over the radius^k.
  int terms_over(const HeldMotion& m, const Branch& branch, double x, double e, double omega, double h,
                 const HeldTorques& held, const SineAndCosine& arm, const TaylorAccuracy& accuracy) const {
    const auto [aside, highest] = has_tail_ ? bounds_with_tail(x, e) : bounds_without_tail(x, e);
    const double bent = std::abs(branch.bend) * highest;
    if (!(bent <= 0.5)) return 0;

    constexpr double cosh_1 = 1.544;
    const double v = std::abs(omega), rise = aside / per_speed_, fastest = v + rise;  // speeds within the radius
    const double beyond = std::abs(held.beyond) + cosh_1 * std::abs(m.lift) + std::abs(m.skew) * fastest;
    const double uneven = cosh_1 * std::abs(m.gravity) + std::abs(m.drag) * fastest +
                          std::abs(branch.pull) * (highest / (1.0 - bent)) * beyond;
    const double alpha = (std::abs(held.push) + uneven) * above_one;
    const double ratio = h * std::max(alpha / rise, fastest);  // of the step to the radius
    if (!(ratio <= 0.5)) return 0;

    const double change = alpha * h;
    if (!(m.motion * omega > change)) return 0;
    if (m.flank != 0.0) {
      const double distance = held.beyond - m.lift * arm.cosine - m.skew * omega;
      const double nearing = std::abs(m.lift) * ((v + change) * h) + std::abs(m.skew) * change;
      if (!(-m.flank * distance > nearing)) return 0;
    }
    const double allowed = accuracy.allowed(v + change, h) * (1.0 - ratio);
    double error = uneven * (ratio * ratio);  // of the acceleration
    for (int terms = 2; terms <= longest; ++terms, error *= ratio)
      if (error * reciprocal[terms + 1] <= allowed) return terms;
    return 0;
  }

  /// A distance from x in the complex plane, and the most that |e| comes to within it.
  struct Disc {
    double aside, highest;
  };
  /// exp(-x^p) where x^p changes by at most `far`, or has no negative real part.
  Disc bounds_without_tail(double x, double e) const {
    constexpr double far = 3.0, exp_far = 20.1;
    constexpr std::array<double, 5> nowhere_negative{0.0, 0.999, 0.707, 0.499, 0.382};  // sin(pi/(2p))
    constexpr std::array<double, 5> root_of_far{0.0, 3.0, 1.733, 1.443, 1.317};
    // (x + r)^p - x^p <= p r (x + root of far)^(p-1)
    const double aside = far / (exponent_ * below_power(x + root_of_far[exponent_]));
    const double wide = nowhere_negative[exponent_] * x;
    return wide > aside ? Disc{wide, 1.0} : Disc{aside, e * exp_far};
  }
  /// 1/(1 + x^p) where x^p changes by at most half of 1 + x^p: the distance is less than max(0.8, x/2) where p > 1.
  Disc bounds_with_tail(double x, double e) const {
    return {0.5 / (e * exponent_ * below_power(x + std::max(0.8, 0.5 * x))), 2.0 * e};
  }

  /// How much of the drop is left, e(x^p).
  double left(double power) const { return has_tail_ ? 1.0 / (1.0 + power) : decay(power); }
  /// The rate of u over that of -x^p.
  double rest(double u, double square) const { return has_tail_ ? square : u - bend_ * square; }

  /// The first coefficients at x.
  void start(double x) {
    const double e = left(power(x));
    x_[0] = x;
    square_[0] = x * x;
    u_[0] = e / (1.0 + bend_ * e);
    rest_[0] = rest(u_[0], u_[0] * u_[0]);
  }
  /// Coefficient k of the rate of x^p, times k.
  [[gnu::always_inline]] void raise(int k) {
    double raised = x_[k];
    if (exponent_ > 1) {
      square_[k] = product(k, x_, x_);
      if (exponent_ == 2)
        raised = square_[k];
      else
        raised = product(k, square_, exponent_ == 3 ? x_ : square_);
    }
    slope_[k] = k * raised;
  }
  [[gnu::always_inline]] static double product(int k, const Coefficients& a, const Coefficients& b) {
    double sum = 0.0;
    for (int j = 0; j <= k; ++j) sum += a[j] * b[k - j];
    return sum;
  }

  double drop_ = 0.0, least_ = 0.0, per_speed_ = 0.0;
  int exponent_ = 0;  ///< 0: friction does not fall
  bool has_tail_ = false;
  double pull_ = 0.0, bend_ = 0.0, scale_ = 0.0;
  Coefficients x_{}, square_{}, slope_{}, u_{}, rest_{}, beyond_{};  ///< rest: u - bend u^2, slope: k (x^p)_k
  Coefficients speed_{};                                             ///< in a leap
  ArmSeries arm_;
};

}  // namespace wormdrive
