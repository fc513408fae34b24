#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "events/halt.hpp"
#include "events/polynomial_root.hpp"
#include "events/solver_settings.hpp"
#include "events/taylor_flow.hpp"
#include "events/taylor_nominal.hpp"
#include "events/timetable.hpp"

namespace wormdrive {

/// Power series of the motion and of the guards, to an order and over a step that the tolerances decide: within a step
/// everything is a polynomial, so an event is the first root of one and cannot hide between two steps.
///
/// Between calls nothing is kept but which guards have been positive since the restart.
template <class System>
class TaylorSolver {
 public:
  using Instant = typename System::Instant;

  /// The system must outlive the solver; its inputs may change between restarts, its parameters must not.
  TaylorSolver(const System& system, const SolverSettings& settings)
      : system_(system), accuracy_(settings), max_step_(settings.max_step), nominal_(system) {}

  /// Takes up a new state.
  void restart(const Instant& now) {
    ++count_.restarts;
    armed_.fill(false);
    if (nominal_.covers()) nominal_.begin(system_, now);
    else traced_.begin(system_, now);
  }

  /// Integrates to next, past which nothing is evaluated; returns the guard that stopped it earlier.
  std::optional<int> advance(Instant& now, double next, double /*limit*/) {
    while (!already_there(now.t, next)) {
      if constexpr (ClosedForm<System>::known) {
        if (nominal_.covers() && next - now.t <= max_step_ && nominal_.leap(now, next, accuracy_)) {
          ++count_.steps;
          ++count_.evaluations;
          armed_.fill(true);
          return std::nullopt;
        }
      }
      if (const auto guard = step(now, next)) return guard;
    }
    now.t = next;
    return std::nullopt;
  }

  /// What the solver did since it was made; an evaluation is one power series of the motion.
  SolverStatistics statistics() const {
    SolverStatistics sum = count_;
    sum.guard_evaluations = search_.evaluations();
    return sum;
  }

 private:
  std::optional<int> step(Instant& now, double next) {
    const double h = std::min(next - now.t, max_step_);
    if (nominal_.covers()) nominal_.expand(system_, now, h, accuracy_, series_);
    else traced_.expand(system_, now, h, accuracy_, series_);
    ++count_.steps;
    ++count_.evaluations;
    if (!std::isfinite(series_.omega[1]) || !std::isfinite(series_.omega[series_.order]))
      throw SolverFault("the acceleration is not a finite number");
    if (!armed_[System::speed_guard] && now.x[1] == 0.0) leave_rest();

    // The end of the step is a double, and the step ends there exactly.
    double end = series_.step < next - now.t ? std::min(now.t + series_.step, next) : next;
    if (end == now.t) {
      if (++stalled_ > most_stalled) throw SolverFault("the step size fell below the resolution of time");
      end = std::nextafter(now.t, next);
    } else {
      stalled_ = 0;
    }
    std::optional<int> fired;
    for (int g = 0; g < System::guard_count; ++g) {
      const RootSearch::Fall fall = search_.first_fall(series_.guard(g), end - now.t, armed_[g]);
      armed_[g] = armed_[g] || fall.armed;
      if (!fall.at || (fired && now.t + *fall.at >= end)) continue;
      end = time_of(g, now.t, *fall.at, end);
      fired = g;
    }
    const double s = end - now.t;
    now = {end, {value(series_.angle(), s), value(series_.speed(), s)}, now.mode};
    return fired;
  }

  /// Motion from rest: what the start holds of speed and acceleration is rounding, and would point anywhere.
  void leave_rest() {
    const std::size_t roots = std::min(start_roots(series_.speed()), static_cast<std::size_t>(series_.order));
    for (std::size_t k = 0; k < roots; ++k)
      series_.omega[k] = series_.theta[k + 1] = series_.guards[System::speed_guard][k] = 0.0;
  }

  /// The first double at which a guard is no longer positive, for a root at s after t.
  double time_of(int g, double t, double s, double end) const {
    double then = std::min(t + s, end);
    for (int ulp = 0; ulp < 4 && then < end && value(series_.guard(g), then - t) > 0.0; ++ulp)
      then = std::nextafter(then, end);
    return then;
  }

  static constexpr int most_stalled = 1000;

  const System& system_;
  TaylorAccuracy accuracy_;
  double max_step_;
  typename ClosedForm<System>::Flow nominal_;
  TracedFlow<System> traced_;
  Expansion<System::guard_count> series_;
  RootSearch search_;
  std::array<bool, System::guard_count> armed_{};
  int stalled_ = 0;
  SolverStatistics count_{};
};

}  // namespace wormdrive
