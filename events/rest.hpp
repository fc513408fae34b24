#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/numbers/crossing.hpp"
#include "core/ripple.hpp"
#include "events/bend_watch.hpp"
#include "events/segment_start.hpp"
#include "events/simulation_failure.hpp"

namespace wormdrive {

/// A guard falling through zero at a time [s].
struct Crossing {
  double t;
  int guard;
};

/// Finds when a system at rest is released: a right-hand side of zero gives an ODE solver nothing to choose its step
/// by, so the guards are followed over time themselves, with values and rates at both ends of every step.
template <class System>
class RestWatch {
 public:
  using Instant = typename System::Instant;

  RestWatch(const System& system, const Instant& now) : system_(system), now_(now) {}

  /// The first crossing in [now.t, end].
  std::optional<Crossing> first_crossing(double end) {
    Guards left = guards_at(now_.t);
    const auto starts = guard_starts(system_, now_, left);
    if (starts.fallen != no_guard) return Crossing{now_.t, starts.fallen};
    floor_ = starts.floor;
    for (std::size_t g = 0; g < floor_.size(); ++g) left[g][0] += floor_[g];
    // Torques that neither swing nor rise stay as they are; most samples of a drive at rest end here.
    if (fastest_change(system_, now_) == 0.0 && steady(left) && steady(guards_at(end))) return std::nullopt;
    BendWatch<System> bends(system_);
    bends.begin(now_);
    for (double a = now_.t; a < end;) {
      const double step = step_from(a, end);
      const double b = a + step > a ? std::min(end, a + step) : end;  // within an ulp of a report there is one step
      const Guards right = guards_at(b);
      std::optional<Crossing> first;
      for (int g = 0; g < System::guard_count; ++g) {
        const auto guard = [&](double t) { return guards_at(t)[g]; };
        const auto t = falling_crossing(guard, a, left[g], b, right[g]);
        if (t && (!first || *t < first->t)) first = Crossing{*t, g};
      }
      if (const auto bend = bends.first_between([this](double t) { return at(t); }, a, b, at(b)))
        if (!first || *bend < first->t) first = Crossing{*bend, bends.guard};
      if (first) return first;
      a = b;
      left = right;
      for (std::size_t g = 0; g < floor_.size(); ++g)
        if (left[g][0] > 2.0 * floor_[g]) left[g][0] -= std::exchange(floor_[g], 0.0);
    }
    return std::nullopt;
  }

 private:
  using Guards = decltype(std::declval<const System&>().guards_ahead(std::declval<const Instant&>()));

  Instant at(double t) const {
    Instant then = now_;
    then.t = t;
    return then;
  }
  Guards guards_at(double t) const {
    Guards guards = system_.guards_ahead(at(t));
    for (int g = 0; g < System::guard_count; ++g) {
      if (!std::isfinite(guards[g][0])) throw SolverFault("a guard of the state of rest is not a finite number");
      guards[g][0] += floor_[g];
    }
    return guards;
  }

  static bool steady(const Guards& guards) {
    return std::all_of(guards.begin(), guards.end(), [](const auto& guard) { return guard[1] == 0.0; });
  }

  /// Short against the fastest input from a on, so that a guard turns at most once within a step.
  double step_from(double a, double end) const {
    const double omega = fastest_change(system_, at(a)), span = end - now_.t;
    return omega > 0.0 ? std::min(phase_between_looks(true) / omega, span) : span / 8.0;
  }

  const System& system_;
  Instant now_;
  std::array<double, System::guard_count> floor_{};  ///< of a guard that starts at zero, until it is well above
};

}  // namespace wormdrive
