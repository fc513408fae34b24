#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/numbers/rounded.hpp"
#include "events/segment_start.hpp"
#include "events/taylor/accuracy.hpp"
#include "events/taylor/series_step.hpp"
#include "events/taylor/tapes/traced.hpp"

namespace wormdrive {

/// The motion of any drive as power series: the equations of core/ themselves, recorded where a step begins, or where a
/// tie does not let that be, with a series for a scalar.
///
/// A branch that an equation takes behind the start, as a table does at its points, is not in the series. So every
/// step is tried: where acceleration and guards on the way are not those of the series, it ends at the branch.
template <class System>
class SeriesFlow {
 public:
  using Instant = typename System::Instant;
  static constexpr int effect_states = System::state_size - 2;
  using Motion = Expansion<System::guard_count, effect_states>;

  /// The motion from now on, accurate over a step of at most h.
  void expand(const System& system, const Instant& now, double h, const TaylorAccuracy& accuracy, Motion& e) {
    constexpr int lowest = 8, higher = 6;
    is_traced_ = traced_.begin(system, now);
    for (int order = lowest;; order += higher) {
      is_traced_ ? traced_.extend(order, e) : look_ahead(system, now, order, e);
      e.step = h;
      if (accuracy.suffices(e, h)) break;
      if (order + higher <= highest_order && order < accuracy.order()) continue;
      e.step = accuracy.step(e, h);
      break;
    }
    if (is_traced_) e.step = traced_.end_of_rise(e.step);
    if (!(is_traced_ && traced_.remain(e.step))) end_where_it_fails(system, now, accuracy, e);
  }

  /// The quantities at whose zeros the equations bend, along the motion that was expanded last.
  std::vector<Coefficients> bends() { return is_traced_ ? traced_.bends() : bends_; }

  /// The state s after the start of a series.
  static typename System::State state_after(const Motion& e, double s) {
    typename System::State x;
    x[0] = value(e.angle(), s);
    x[1] = value(e.speed(), s);
    for (int k = 0; k < effect_states; ++k) x[2 + k] = value(e.state(k), s);
    return x;
  }

  /// Ends the step where the equations are no longer those of the series.
  static void end_where_it_fails(const System& system, const Instant& now, const TaylorAccuracy& accuracy, Motion& e) {
    const Rates rates = rates_of(e);
    const auto step = [&](const Roundings& inputs) {
      return longest(e.step, [&](double s) { return holds(system, now, s, accuracy, e, rates, inputs); });
    };
    const double whole = e.step;
    if (step({}) == whole) return;
    e.step = step(roundings(system, now));
    // a branch at an angle is known to the rounding of the angle: steps that leave it as it is would never get there
    const double passed = epsilon * std::abs(now.x[0] / now.x[1]);
    if (passed * std::abs(e.omega[1]) < std::abs(now.x[1])) e.step = std::max(e.step, std::min(passed, whole));
  }

 private:
  /// Angle, speed, states and guards to an order, and the bends, by the equations with a series for a scalar.
  void look_ahead(const System& system, const Instant& now, int order, Motion& e) {
    const auto at = system.ahead(now, order + 1);
    const auto guards = system.guards(at, now.mode);
    e.order = order;
    std::copy_n(at.theta_g.c.begin(), order + 2, e.theta.begin());
    std::copy_n(at.omega_g.c.begin(), order + 1, e.omega.begin());
    for (int g = 0; g < System::guard_count; ++g) std::copy_n(guards[g].c.begin(), order + 1, e.guards[g].begin());
    if constexpr (effect_states > 0)
      for (int k = 0; k < effect_states; ++k) std::copy_n(at.states[k].c.begin(), order + 1, e.states[k].begin());
    bends_.clear();
    system.for_each_bend(at, now.mode.motion, [this](const auto& b) { bends_.push_back(b.c); });
  }

  /// What acceleration [rad/s^2], rates of states and guards [their units] may differ by because inputs and torques are
  /// rounded.
  struct Roundings {
    double acceleration = 0.0;
    std::array<double, effect_states> states{};
    std::array<double, System::guard_count> guards{};
  };
  /// Where torques all but cancel, or a sinusoid passes zero, this is more than the tolerance of what is left.
  static Roundings roundings(const System& system, const Instant& now) {
    const auto ahead = system.template ahead<1, Rounded>(now);
    const auto guards = system.guards(ahead, now.mode);
    Roundings of;
    of.acceleration = roundings_of_series * ahead.omega_g[1].rounding;
    if constexpr (effect_states > 0)
      for (int k = 0; k < effect_states; ++k) of.states[k] = roundings_of_series * ahead.states[k][1].rounding;
    for (int g = 0; g < System::guard_count; ++g) of.guards[g] = roundings_of_series * guards[g][0].rounding;
    return of;
  }

  /// The rates of speed and states.
  using Rates = std::array<Coefficients, 1 + effect_states>;
  static Rates rates_of(const Motion& e) {
    Rates rates{};
    for (int k = 1; k <= e.order; ++k) {
      rates[0][k - 1] = k * e.omega[k];
      for (int j = 0; j < effect_states; ++j) rates[1 + j][k - 1] = k * e.states[j][k];
    }
    return rates;
  }

  /// Whether the equations at s are those that the series was made from.
  static bool holds(const System& system, const Instant& now, double s, const TaylorAccuracy& accuracy, const Motion& e,
                    const Rates& rates, const Roundings& inputs) {
    const double t = now.t + s;
    const auto near = [&](double found, Polynomial c, double allowed) {
      const double expected = value(c, s), error = std::abs(found - expected);
      // its terms together are no smaller than the value
      if (error <= allowed + (accuracy.relative() + rounding) * std::abs(expected)) return true;
      double size = 0.0, rate = 0.0, power = 1.0;
      for (std::size_t k = 0; k < c.size(); ++k, power *= s) {
        size += std::abs(c[k]) * power;
        if (k + 1 < c.size()) rate += static_cast<double>(k + 1) * std::abs(c[k + 1]) * power;
      }
      // the inputs know the time to its own rounding only
      return error <= allowed + (accuracy.relative() + rounding) * size + 4.0 * epsilon * std::abs(t) * rate;
    };
    Instant then = now;
    then.t = t;
    then.x = state_after(e, s);
    const auto there = system.moment(then);
    const auto follows = [&](double found, const Coefficients& rate, double value_there, double rounded) {
      return near(found, {rate.data(), static_cast<std::size_t>(e.order)},
                  e.order * accuracy.allowed(value_there) + rounded);
    };
    if (!follows(system.acceleration(there, now.mode), rates[0], there.omega_g, inputs.acceleration)) return false;
    if constexpr (effect_states > 0) {
      const auto found = system.state_rates(there, now.mode);
      for (int k = 0; k < effect_states; ++k)
        if (!follows(found[k], rates[1 + k], then.x[2 + k], inputs.states[k])) return false;
    }
    const auto guards = system.guards(there, now.mode);
    const auto terms = system.guard_terms(there, now.mode);
    for (int g = 0; g < System::guard_count; ++g)
      if (!near(guards[g], e.guard(g), rounding * terms[g] + inputs.guards[g])) return false;
    return true;
  }

  static constexpr double epsilon = std::numeric_limits<double>::epsilon(), rounding = 64.0 * epsilon;

  TracedMotion<System> traced_;
  bool is_traced_ = false;           ///< the latest motion, else it was looked ahead ...
  std::vector<Coefficients> bends_;  ///< ... and so were these
};

}  // namespace wormdrive
