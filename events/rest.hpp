#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/crossing.hpp"
#include "events/halt.hpp"

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

  /// The first crossing in [now.t, end]; a guard that starts below zero counts once it has been positive.
  std::optional<Crossing> first_crossing(double end) const {
    std::array<bool, System::guard_count> armed;
    Guards left = guards_at(now_.t);
    for (int g = 0; g < System::guard_count; ++g) {
      if (left[g][0] <= 0.0 && left[g][1] < 0.0) return Crossing{now_.t, g};  // though rounding put it a hair below
      armed[g] = left[g][0] >= 0.0;
    }
    // Torques that neither swing nor rise stay as they are; most samples of a drive at rest end here.
    if (system_.fastest_input(now_.t) == 0.0 && steady(left) && steady(guards_at(end))) return std::nullopt;
    for (double a = now_.t; a < end;) {
      const double step = step_from(a, end);
      const double b = a + step > a ? std::min(end, a + step) : end;  // within an ulp of a report there is one step
      const Guards right = guards_at(b);
      std::optional<Crossing> first;
      for (int g = 0; g < System::guard_count; ++g) {
        const auto guard = [&](double t) { return guards_at(t)[g]; };
        const auto t = armed[g] ? falling_crossing(guard, a, left[g], b, right[g]) : std::nullopt;
        if (t && (!first || *t < first->t)) first = Crossing{*t, g};
        armed[g] = armed[g] || right[g][0] > 0.0;
      }
      if (first) return first;
      a = b;
      left = right;
    }
    return std::nullopt;
  }

 private:
  using Guards = decltype(std::declval<const System&>().guards_ahead(std::declval<const Instant&>()));

  Guards guards_at(double t) const {
    Instant then = now_;
    then.t = t;
    const Guards guards = system_.guards_ahead(then);
    for (const auto& guard : guards)
      if (!std::isfinite(guard[0])) throw SolverFault("a guard of the state of rest is not a finite number");
    return guards;
  }

  static bool steady(const Guards& guards) {
    return std::all_of(guards.begin(), guards.end(), [](const auto& guard) { return guard[1] == 0.0; });
  }

  /// Short against the fastest input from a on, so that a guard turns at most once within a step.
  double step_from(double a, double end) const {
    const double omega = system_.fastest_input(a), span = end - now_.t;
    return omega > 0.0 ? std::min(0.05 / omega, span) : span / 8.0;
  }

  const System& system_;
  Instant now_;
};

}  // namespace wormdrive
