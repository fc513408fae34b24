#pragma once
// The paper's drive once more, in arithmetic of any precision and with nothing of the program in it: what the tests of
// accuracy compare with. It shares the equations on paper (eq. 9, 18-19) and no line of code.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace wormdrive::test {

inline long double sine(long double x) { return std::sin(x); }
inline long double cosine(long double x) { return std::cos(x); }

/// Table 1 with mu = 0.25 under a torque level + wave cos(rate t + phase) against a load a cos theta + b sin theta.
template <class Real>
class ExtendedDrive {
 public:
  struct Event {
    Real t;
    int motion, flank;  ///< after it; flank +1 left, -1 right, 0 at rest
  };
  Real level = 0, wave = 0, rate = 0, phase = 0;
  Real t = 0, theta = 0, omega = 0;
  std::vector<Event> events;

  ExtendedDrive(double load_cosine, double load_sine) : a_(load_cosine), b_(load_sine) {
    // the angles in rad are doubles, as the program's are
    const Real lambda = 4 * (3.14159265358979323846 / 180), phi = 20 * (3.14159265358979323846 / 180);
    const auto C = [&](Real m) {
      return Real(0.011) / Real(0.045) * (cosine(phi) * sine(lambda) - m * cosine(lambda)) /
             (cosine(phi) * cosine(lambda) + m * sine(lambda));
    };
    C1_ = C(Real(0.25));
    C2_ = C(-Real(0.25));
    Jwi_ = Real(2.53e-5) * 60;
    Jg_ = Real(7.39e-4);
  }

  /// Takes up a torque that was set from outside, as the loop does at a sample.
  void settle() {
    if (omega != 0) {
      motion_ = omega > 0 ? 1 : -1;
      flank_ = beyond() <= 0 ? 1 : -1;
    } else {
      start_if_released();
    }
  }

  void advance(Real to) {
    while (t < to) {
      if (motion_ == 0) {
        wait(to);
      } else {
        move(to);
      }
    }
  }

 private:
  static constexpr int order = 30, looks = 16;  // looks for a change of sign within a step
  static constexpr double longest = 0.004;      // step [s], far below the time in which anything here changes
  using Polynomial = std::array<Real, order + 2>;

  Real torque() const { return level + wave * cosine(rate * t + phase); }
  Real load() const { return a_ * cosine(theta) + b_ * sine(theta); }
  Real beyond() const { return torque() - Jwi_ / Jg_ * load(); }
  Real C() const { return motion_ * flank_ > 0 ? C1_ : C2_; }

  static Real at(const Polynomial& p, Real s) {
    Real sum = 0;
    for (int k = order + 1; k-- > 0;) sum = sum * s + p[k];
    return sum;
  }
  /// The root of f between a and b, which have different signs.
  template <class F>
  static Real bisected(F&& f, Real a, Real b) {
    const bool rises = f(b) > 0;
    for (int k = 0; k < 130; ++k) {
      const Real middle = (a + b) / 2;
      ((f(middle) > 0) == rises ? b : a) = middle;
    }
    return b;
  }

  void start_if_released() {
    const Real push = torque(), low = std::min(-C1_ * load(), -C2_ * load()),
               high = std::max(-C1_ * load(), -C2_ * load());
    motion_ = push > high ? 1 : push < low ? -1 : 0;
    flank_ = motion_ == 0 ? 0 : beyond() <= 0 ? 1 : -1;
  }

  void wait(Real to) {
    const Real from = t, h = std::min(Real(longest), to - t);
    const Real low = std::min(-C1_ * load(), -C2_ * load()), high = std::max(-C1_ * load(), -C2_ * load());
    const auto torque_at = [&](Real s) { return level + wave * cosine(rate * (from + s) + phase); };
    for (int k = 1; k <= looks; ++k) {
      const Real s = h * k / looks;
      if (torque_at(s) <= high && torque_at(s) >= low) continue;
      const bool forward = torque_at(s) > high;
      t = from + bisected([&](Real x) { return torque_at(x) - (forward ? high : low); }, h * (k - 1) / looks, s);
      motion_ = forward ? 1 : -1;
      flank_ = beyond() <= 0 ? 1 : -1;
      events.push_back({t, motion_, flank_});
      return;
    }
    t = h < to - from ? from + h : to;
  }

  void move(Real to) {
    Polynomial x{}, v{}, u{}, s{}, c{}, push{};
    const Real inertia = Jwi_ + C() * Jg_, h = std::min(Real(longest), to - t);
    Real even = wave * cosine(rate * t + phase), odd = -wave * sine(rate * t + phase), factor = 1;
    for (int k = 0; k <= order; ++k) {
      push[k] = (k % 2 == 0 ? even : odd) * factor;
      if (k % 2 == 1) even = -even, odd = -odd;
      factor = factor * rate / (k + 1);
    }
    push[0] += level;
    x[0] = theta;
    v[0] = omega;
    s[0] = sine(theta);
    c[0] = cosine(theta);
    for (int k = 0; k <= order; ++k) {
      for (int j = 1; j <= k; ++j) {
        s[k] += j * x[j] * c[k - j] / k;
        c[k] -= j * x[j] * s[k - j] / k;
      }
      const Real load_k = a_ * c[k] + b_ * s[k];
      u[k] = push[k] - Jwi_ / Jg_ * load_k;
      x[k + 1] = v[k] / (k + 1);
      v[k + 1] = (push[k] + C() * load_k) / inertia / (k + 1);
    }
    const int motion = motion_, flank = flank_;
    for (int k = 1; k <= looks; ++k) {
      const Real end = h * k / looks, begin = h * (k - 1) / looks;
      Real first = end;
      int kind = 0;
      if (motion * at(v, end) <= 0) first = bisected([&](Real r) { return at(v, r); }, begin, end), kind = 1;
      if (flank * at(u, end) > 0) {
        const Real r = bisected([&](Real q) { return at(u, q); }, begin, end);
        if (kind == 0 || r < first) first = r, kind = 2;
      }
      if (kind == 0) continue;
      t += first;
      theta = at(x, first);
      omega = kind == 1 ? Real(0) : at(v, first);
      if (kind == 1)
        start_if_released();
      else
        flank_ = -flank_;
      events.push_back({t, motion_, flank_});
      return;
    }
    t = h < to - t ? t + h : to;
    theta = at(x, h);
    omega = at(v, h);
  }

  Real a_, b_, C1_, C2_, Jwi_, Jg_;
  int motion_ = 0, flank_ = 0;
};

}  // namespace wormdrive::test
