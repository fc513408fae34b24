#pragma once
#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>
#include <optional>

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
      if (left[g][0] <= 0.0 && left[g][1] < 0.0) return Crossing{now_.t, g};
      armed[g] = left[g][0] >= 0.0;
    }
    const double step = step_for(end);
    for (double a = now_.t; a < end;) {
      const double b = std::min(end, a + step);
      const Guards right = guards_at(b);
      std::optional<Crossing> first;
      for (int g = 0; g < System::guard_count; ++g) {
        const auto t = armed[g] ? crossing_in(g, a, left[g], b, right[g]) : std::nullopt;
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
  using Guard = typename Guards::value_type;

  Guards guards_at(double t) const {
    Instant then = now_;
    then.t = t;
    return system_.guards_ahead(then);
  }

  /// Short against the fastest input, so that a guard turns at most once within a step.
  double step_for(double end) const {
    const double omega = system_.fastest_input(), span = end - now_.t;
    return omega > 0.0 ? std::min(0.05 / omega, span) : span / 8.0;
  }

  std::optional<double> crossing_in(int g, double a, const Guard& left, double b, const Guard& right) const {
    if (right[0] < 0.0) return root(a, left[0], b, right[0], [&](double t) { return guards_at(t)[g][0]; });
    if (left[1] >= 0.0 || right[1] <= 0.0) return std::nullopt;
    // falls at a, rises at b: the lowest point lies between
    const double lowest = root(a, left[1], b, right[1], [&](double t) { return guards_at(t)[g][1]; });
    const double value = guards_at(lowest)[g][0];
    if (value >= 0.0) return std::nullopt;
    return root(a, left[0], lowest, value, [&](double t) { return guards_at(t)[g][0]; });
  }

  template <class F>
  static double root(double a, double fa, double b, double fb, F&& f) {
    if (fa == 0.0) return a;
    if (fb == 0.0) return b;
    std::uintmax_t iterations = 200;
    const auto bracket = boost::math::tools::toms748_solve(f, a, b, fa, fb,
                                                           boost::math::tools::eps_tolerance<double>(), iterations);
    return bracket.second;
  }

  const System& system_;
  Instant now_;
};

}  // namespace wormdrive
