#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <Eigen/Core>

#include "events/sensitivity/derivative_scales.hpp"
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

  /// The drive must outlive this; its inputs may change between restarts. by: the parameters that are followed.
  SeriesSensitivity(const Drive& drive, std::span<const Parameter> by, const SolverSettings& settings)
      : drive_(drive),
        relative_(settings.relative_tolerance),
        negligible_(settings.absolute_tolerance / settings.relative_tolerance),
        max_step_(settings.max_step),
        scales_(by) {}

  /// Takes up a new state; behind the limit [s] the inputs or the mode differ.
  void restart(const Instant& now, double limit) {
    end_ = now.t;
    limit_ = limit;
    scales_.see(drive_, now);
    largest_.col(0) = largest_.col(0).max(negligible_);
    for (int k = 0; k < T::DIMENSION; ++k) largest_.col(1 + k) = largest_.col(1 + k).max(negligible_ * scales_[k]);
  }

  /// Carries the state to t, at most the limit.
  void advance(Instant& now, double t) {
    while (!already_there(now.t, t)) {
      if (now.t >= end_) step(now);
      now.t = std::min(t, end_);
      now.x = value(now.t - begin_.t);
    }
    now.t = t;
  }

 private:
  static constexpr int lowest_order = 8, higher = 6, highest_order = 20;
  static constexpr int components = 1 + T::DIMENSION;
  using Sizes = Eigen::Array<double, Drive::state_size, components>;  ///< of every state with its derivatives

  static double component(const T& x, int c) { return c == 0 ? x.a : x.v[c - 1]; }

  void step(const Instant& now) {
    begin_ = now;
    const double span = std::min(limit_ - now.t, max_step_);
    double h = expand(span);
    h = longest(h, [&](double s) { return holds(s); });
    end_ = h < limit_ - now.t ? now.t + h : limit_;
    if (end_ == now.t) throw SolverFault("the step size fell below the resolution of time");
    largest_ = sizes_over(h);
  }

  /// Makes the series from begin_ on, and returns the step within h over which they suffice.
  double expand(double h) {
    double share = 0.0;
    for (order_ = lowest_order;; order_ += higher) {
      const auto states = Drive::state_at(drive_.ahead(begin_, order_));
      for (int k = 0; k <= order_; ++k)
        for (int row = 0; row < Drive::state_size; ++row) c_[k][row] = states[row][k];
      for (const int k : {1, order_})
        for (const T& c : c_[k])
          if (!std::isfinite(c.a)) throw SolverFault("the acceleration is not a finite number");
      share = shortening(h);
      if (share >= 1.0 || order_ == highest_order) break;
    }
    for (; share < 1.0; share = shortening(h)) h *= std::min(share, 0.95);
    return h;
  }

  /// The sizes of all that has a rate of its own over a step of h, seen so far or to come: what errors are relative to.
  Sizes sizes_over(double h) const {
    Sizes sums = Sizes::Zero();
    double power = 1.0;
    for (int k = 0; k <= order_; ++k, power *= h)
      for (int row = first_row; row < Drive::state_size; ++row)
        for (int c = 0; c < components; ++c) sums(row, c) += std::abs(component(c_[k][row], c)) * power;
    return sums.max(largest_);
  }

  /// The share of h over which the last terms of every component are negligible, 1 if they are over h.
  double shortening(double h) const {
    constexpr int window = 4;  // of terms, for every second one or more may happen to vanish
    const Sizes sizes = sizes_over(h);
    double share = 1.0;
    for (int k = order_ - window + 1; k <= order_; ++k) {
      const double power = std::pow(h, k);
      for (int row = first_row; row < Drive::state_size; ++row)
        for (int c = 0; c < components; ++c) {
          const double excess = std::abs(component(c_[k][row], c)) * power / (relative_ * sizes(row, c));
          if (excess > 1.0) share = std::min(share, std::pow(excess, -1.0 / k));
        }
    }
    return share;
  }

  /// Whether the rates and their derivatives at s are those of the series: a table changes its law at its points.
  bool holds(double s) const {
    const State found = drive_.derivative(begin_.t + s, value(s), begin_.mode);
    const Sizes sizes = sizes_over(s);
    State rate = State::Constant(T(0.0));
    Sizes terms = Sizes::Zero();
    double power = 1.0;
    for (int k = 1; k <= order_; ++k, power *= s)
      for (int row = first_row; row < Drive::state_size; ++row) {
        rate[row] += static_cast<double>(k) * power * c_[k][row];
        for (int c = 0; c < components; ++c) terms(row, c) += k * power * std::abs(component(c_[k][row], c));
      }
    for (int row = first_row; row < Drive::state_size; ++row)
      for (int c = 0; c < components; ++c) {
        const double allowed = order_ * relative_ * sizes(row, c) / s + rounding * terms(row, c);
        if (!(std::abs(component(found[row], c) - component(rate[row], c)) <= allowed)) return false;
      }
    return true;
  }

  State value(double s) const {
    State sum = c_[order_];
    for (int k = order_; k-- > 0;) sum = c_[k] + T(s) * sum;
    return sum;
  }

  static constexpr int first_row = 1;  ///< the angle has the rate that the speed is
  static constexpr double rounding = 1024.0 * std::numeric_limits<double>::epsilon();

  const Drive& drive_;
  double relative_;
  double negligible_;  ///< size below which the relative tolerance asks for nothing
  double max_step_;
  Instant begin_{};  ///< of the present step
  double end_ = 0.0, limit_ = 0.0;
  int order_ = 0;
  std::array<State, highest_order + 1> c_{};  ///< coefficients of the series
  DerivativeScales<Drive> scales_;
  Sizes largest_ = Sizes::Zero();  ///< along the run
};

}  // namespace wormdrive
