#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "events/bend_watch.hpp"
#include "events/segment_start.hpp"
#include "events/solver_settings.hpp"
#include "events/taylor/accuracy.hpp"
#include "events/taylor/expansion.hpp"
#include "events/taylor/polynomial_root.hpp"
#include "events/taylor/series_step.hpp"
#include "events/timetable.hpp"

namespace wormdrive {

/// The first step of a segment that begins with a shaft at speed zero, by power series. The acceleration there may be
/// rounding: an integrator that starts with it may leave in either direction, and never comes to see its own stop. The
/// series knows which derivative is the first that counts, and its guards are polynomials.
template <class System>
class FirstStep {
 public:
  using Instant = typename System::Instant;

  /// From now on, no further than limit [s] and max_step.
  FirstStep(const System& system, const Instant& now, double limit, double max_step, const SolverSettings& settings)
      : system_(system), begin_(now), accuracy_(settings) {
    const auto at = system.ahead(now, order + 1);
    const auto start = system.template ahead<leading, Rounded>(now);
    const auto flow = System::state_at(at);
    const auto rounded = System::state_at(start);
    const auto guards = system.guards(at, now.mode);
    const auto rounded_guards = system.guards(start, now.mode);
    double h = std::min(limit - now.t, max_step);
    for (int shaft = 0; shaft < shafts; ++shaft) {
      Motion& e = motion_[shaft];
      e.order = order;
      take(flow[2 * shaft], rounded[2 * shaft], e.theta);
      take(flow[2 * shaft + 1], rounded[2 * shaft + 1], e.omega);
      rounding_[shaft] = roundings_of_series * rounded[2 * shaft + 1][1].rounding;
      for (int g = 0; g < System::guard_count; ++g) take(guards[g], rounded_guards[g], e.guards[g]);
      h = accuracy_.step(e, h);
    }
    for (int k = 0; k < others; ++k) {
      take(flow[2 * shafts + k], rounded[2 * shafts + k], others_[k]);
      rounding_[shafts + k] = roundings_of_series * rounded[2 * shafts + k][1].rounding;
    }
    if (BendWatch<System> bends(system); !bends.none()) {
      bends.begin(now);
      h = bends.first_within(bends.along(at, now.mode), order, h, search_).value_or(h);
    }
    h = longest(h, [&](double s) { return holds(s); });
    end_ = h < limit - now.t ? now.t + h : limit;
    brief_ = end_ == now.t && moves(h);
    if (end_ == now.t && !brief_) end_ = std::nextafter(now.t, limit);
    length_ = brief_ ? h : end_ - now.t;
    find_events(rounded_guards);
  }

  double end() const { return end_; }  ///< [s]
  /// How long it is where that is less than time resolves, and the state goes on without the clock; else 0 [s].
  double brief() const { return brief_ ? length_ : 0.0; }
  int fired() const { return fired_; }         ///< the guard that falls through zero at the end, or no_guard
  long evaluations() const { return looks_; }  ///< of the derivative
  /// The motion at a time of the step.
  Instant at(double t) const {
    Instant then = after(t == end_ ? length_ : t - begin_.t);
    then.t = t;
    return then;
  }

 private:
  static constexpr int order = 8, shafts = shaft_count<System>();
  static constexpr int others = System::state_size - 2 * shafts;  ///< states behind those of the shafts
  static constexpr int leading = 4;  ///< coefficients that decide where the motion goes, and are more than rounding
  using Motion = Expansion<System::guard_count>;

  /// Coefficients without those that are rounding; a value is what it is. Before one that counts, none does that
  /// whoever let the motion begin could not judge.
  static void take(const OpenSeries<double>& from, const Series<Rounded, leading>& rounded, Coefficients& to) {
    int decides = 1;
    while (decides <= leading && std::abs(rounded[decides].value) <= blur(rounded, decides, 0.0)) ++decides;
    if (decides > leading) decides = 1;
    for (int k = 0; k <= order + 1; ++k)
      to[k] = k > 0 && (k < decides || (k <= leading && rounded[k].vanishes())) ? 0.0 : from[k];
  }

  Instant after(double s) const {
    Instant then = begin_;
    then.t += s;
    for (int shaft = 0; shaft < shafts; ++shaft) {
      then.x[2 * shaft] = value(motion_[shaft].angle(), s);
      then.x[2 * shaft + 1] = value(motion_[shaft].speed(), s);
    }
    for (int k = 0; k < others; ++k) then.x[2 * shafts + k] = value(Polynomial(others_[k].data(), order + 2), s);
    system_.keep_within_mode(then);
    return then;
  }
  /// Whether a speed is another one after s.
  bool moves(double s) const {
    const Instant then = after(s);
    for (int shaft = 0; shaft < shafts; ++shaft)
      if (then.x[2 * shaft + 1] != begin_.x[2 * shaft + 1]) return true;
    return false;
  }

  /// Whether the equations at s are those that the series was made from: a table changes its law on the way.
  bool holds(double s) {
    ++looks_;
    const Instant there = after(s);
    const auto rates = system_.derivative(there.t, there.x, there.mode);
    const auto follows = [&](const Coefficients& c, int state, double rounding) {
      double rate = 0.0, size = 0.0, power = 1.0;
      for (int k = 1; k <= order; ++k, power *= s) {
        rate += k * c[k] * power;
        size += std::abs(k * c[k] * power);
      }
      const double within = 64.0 * std::numeric_limits<double>::epsilon() * size;
      const double allowed = order * accuracy_.allowed(there.x[state]) + accuracy_.relative() * size;
      return std::abs(rates[state] - rate) <= allowed + within + rounding;
    };
    for (int shaft = 0; shaft < shafts; ++shaft)
      if (!follows(motion_[shaft].omega, 2 * shaft + 1, rounding_[shaft])) return false;
    for (int k = 0; k < others; ++k)
      if (!follows(others_[k], 2 * shafts + k, rounding_[shafts + k])) return false;
    return true;
  }

  /// Ends the step at the first guard that falls through zero.
  template <class Guards>
  void find_events(const Guards& rounded) {
    for (int g = 0; g < System::guard_count; ++g) {
      const auto roots = static_cast<std::size_t>(undecided(rounded[g], time_resolution(begin_.t)));
      const RootSearch::Fall fall = search_.fall_from_start(motion_[0].guard(g), length_, roots);
      if (!fall.at || (fired_ != no_guard && *fall.at >= length_)) continue;
      end_ = std::min(begin_.t + *fall.at, end_);
      length_ = brief_ ? std::min(*fall.at, length_) : end_ - begin_.t;
      fired_ = g;
    }
  }

  const System& system_;
  Instant begin_;
  TaylorAccuracy accuracy_;
  std::array<Motion, shafts> motion_{};
  std::array<Coefficients, others> others_{};
  std::array<double, shafts + others> rounding_{};  ///< of the rates, whose terms may all but cancel
  double end_ = 0.0, length_ = 0.0;                 ///< [s]
  bool brief_ = false;
  int fired_ = no_guard;
  long looks_ = 0;
  RootSearch search_;
};

/// Whether a moving shaft is so slow that what a solver may err by could turn it.
template <class System>
bool creeps(const typename System::Instant& now, const SolverSettings& settings) {
  for (int speed = 1; speed < 2 * shaft_count<System>(); speed += 2)
    if (now.x[speed] != 0.0 && std::abs(now.x[speed]) < 100.0 * settings.absolute_tolerance) return true;
  return false;
}

/// First steps of a segment one behind the other, while it leaves rest or creeps; then an integrator begins.
template <class System>
class FirstSteps {
 public:
  using Instant = typename System::Instant;

  void restart(const System& system, const Instant& now, const SolverSettings& settings) {
    first_.reset();
    made_ = 0;
    waited_ = 0.0;
    if constexpr (Foresees<System>) leaves_rest_ = system.leaves_rest(now) || creeps<System>(now, settings);
  }
  /// Whether one is to be made, or is on its way.
  bool any() const { return leaves_rest_ || first_; }
  bool leaves_rest() const { return leaves_rest_; }

  /// Goes on to a time, unless a guard falls through zero before; false where they are over. make(now): the first step
  /// from there on.
  template <class Make>
  bool advance(Instant& now, double next, const SolverSettings& settings, const Make& make) {
    do {
      if (!first_) first_.emplace(make(now));
      leaves_rest_ = false;
      if (const double brief = first_->brief(); brief > 0.0) {
        now = first_->at(now.t);
        if (first_->fired() != no_guard) return true;
        waited_ += brief;
        const double late = now.t + waited_;
        if (late > now.t) waited_ = 0.0;
        now.t = std::min(late, next);
      } else if (now.t < first_->end()) {
        now = first_->at(std::min(next, first_->end()));
        if (now.t == next || first_->fired() != no_guard) return true;
      }
      first_.reset();
    } while (creeps<System>(now, settings) && ++made_ < most);
    return false;
  }
  /// The guard that has fallen through zero, or no_guard.
  int fired(double t) const { return t < first_->end() ? no_guard : first_->fired(); }

 private:
  static constexpr int most = 1000;  ///< at a standstill of that length an integrator may try

  std::optional<FirstStep<System>> first_;
  int made_ = 0;
  bool leaves_rest_ = false;  ///< the first one is still to be made
  double waited_ = 0.0;       ///< how long the clock has stood for them [s]
};

}  // namespace wormdrive
