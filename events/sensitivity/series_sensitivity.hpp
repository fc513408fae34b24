#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "events/simulation_failure.hpp"
#include "events/solver_settings.hpp"
#include "events/taylor/series_step.hpp"
#include "events/timetable.hpp"

namespace wormdrive {

/// Carries a state with its derivatives by parameters through a mode: the power series of the motion, whose
/// coefficients are Jets. Steps and orders are those that the derivatives need, too: by a parameter that is zero the
/// motion may swing where it is itself a parabola.
template <class Drive>
class SeriesSensitivity {
 public:
  using Instant = typename Drive::Instant;
  using State = typename Drive::State;
  using T = typename State::Scalar;

  /// The drive must outlive this; its inputs may change between restarts.
  SeriesSensitivity(const Drive& drive, const SolverSettings& settings)
      : drive_(drive), relative_(settings.relative_tolerance), max_step_(settings.max_step) {}

  /// Takes up a new state; behind the limit [s] the inputs or the mode differ.
  void restart(const Instant& now, double limit) {
    end_ = now.t;
    limit_ = limit;
  }

  /// Carries the state to t, at most the limit.
  void advance(Instant& now, double t) {
    while (!already_there(now.t, t)) {
      if (now.t >= end_) step(now);
      now.t = std::min(t, end_);
      now.x = {value(theta_, now.t - begin_.t), value(omega_, now.t - begin_.t)};
    }
    now.t = t;
  }

 private:
  static constexpr int lowest_order = 8, higher = 6, highest_order = 20;
  static constexpr int components = 1 + T::DIMENSION;
  using Coefficients = std::array<T, highest_order + 1>;
  using Sizes = std::array<double, components>;

  static double component(const T& x, int c) { return c == 0 ? x.a : x.v[c - 1]; }

  void step(const Instant& now) {
    begin_ = now;
    const double span = std::min(limit_ - now.t, max_step_);
    double h = expand(span);
    h = longest(h, [&](double s) { return holds(s); });
    end_ = h < limit_ - now.t ? now.t + h : limit_;
    if (end_ == now.t) throw SolverFault("the step size fell below the resolution of time");
    const Sizes sizes = sizes_over(h);
    for (int c = 0; c < components; ++c) largest_[c] = std::max(largest_[c], sizes[c]);
  }

  /// Makes the series from begin_ on, and returns the step within h over which they suffice.
  double expand(double h) {
    double share = 0.0;
    for (order_ = lowest_order;; order_ += higher) {
      const auto at = drive_.ahead(begin_, order_);
      std::copy_n(at.theta_g.c.begin(), order_ + 1, theta_.begin());
      std::copy_n(at.omega_g.c.begin(), order_ + 1, omega_.begin());
      for (const double c : {omega_[1].a, omega_[order_].a})
        if (!std::isfinite(c)) throw SolverFault("the acceleration is not a finite number");
      share = shortening(h);
      if (share >= 1.0 || order_ == highest_order) break;
    }
    for (; share < 1.0; share = shortening(h)) h *= std::min(share, 0.95);
    return h;
  }

  /// The size of every component of the speed over a step of h, seen so far or to come: what errors are relative to.
  Sizes sizes_over(double h) const {
    Sizes sizes = largest_;
    for (int c = 0; c < components; ++c) {
      double sum = 0.0, power = 1.0;
      for (int k = 0; k <= order_; ++k, power *= h) sum += std::abs(component(omega_[k], c)) * power;
      sizes[c] = std::max(sizes[c], sum);
    }
    return sizes;
  }

  /// The share of h over which the last terms of every component are negligible, 1 if they are over h.
  double shortening(double h) const {
    constexpr int window = 4;  // of terms, for every second one or more may happen to vanish
    const Sizes sizes = sizes_over(h);
    double share = 1.0;
    for (int k = order_ - window + 1; k <= order_; ++k) {
      const double power = std::pow(h, k);
      for (int c = 0; c < components; ++c) {
        const double excess = std::abs(component(omega_[k], c)) * power / (relative_ * sizes[c]);
        if (excess > 1.0) share = std::min(share, std::pow(excess, -1.0 / k));
      }
    }
    return share;
  }

  /// Whether the acceleration and its derivatives at s are those of the series: a table changes its law at its points.
  bool holds(double s) const {
    const T found =
        drive_.acceleration(drive_.moment(T(begin_.t + s), value(theta_, s), value(omega_, s)), begin_.mode);
    const Sizes sizes = sizes_over(s);
    T rate(0.0);
    Sizes terms{};
    double power = 1.0;
    for (int k = 1; k <= order_; ++k, power *= s) {
      rate += static_cast<double>(k) * power * omega_[k];
      for (int c = 0; c < components; ++c) terms[c] += k * power * std::abs(component(omega_[k], c));
    }
    for (int c = 0; c < components; ++c) {
      const double allowed = order_ * relative_ * sizes[c] / s + rounding * terms[c];
      if (!(std::abs(component(found, c) - component(rate, c)) <= allowed)) return false;
    }
    return true;
  }

  T value(const Coefficients& c, double s) const {
    T sum = c[order_];
    for (int k = order_; k-- > 0;) sum = c[k] + s * sum;
    return sum;
  }

  static constexpr double rounding = 1024.0 * std::numeric_limits<double>::epsilon();

  const Drive& drive_;
  double relative_, max_step_;
  Instant begin_{};  ///< of the present step
  double end_ = 0.0, limit_ = 0.0;
  int order_ = 0;
  Coefficients theta_{}, omega_{};
  Sizes largest_{};  ///< of speed and its derivatives along the run
};

}  // namespace wormdrive
