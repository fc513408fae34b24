#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/ripple.hpp"
#include "events/bend_watch.hpp"
#include "events/segment_start.hpp"
#include "events/simulation_failure.hpp"
#include "events/solver_settings.hpp"
#include "events/taylor/nominal/flow.hpp"
#include "events/taylor/polynomial_root.hpp"
#include "events/taylor/series.hpp"
#include "events/taylor/tapes/flow.hpp"
#include "events/taylor/vanishing_at_start.hpp"
#include "events/timetable.hpp"

namespace wormdrive {

/// Power series of the motion and of the guards, to an order and over a step that the tolerances decide: within a step
/// everything is a polynomial, so an event is the first root of one and cannot hide between two steps. Reports are
/// values of these polynomials and do not cut the steps.
template <class System>
class TaylorSolver {
 public:
  using Instant = typename System::Instant;

  /// The system must outlive the solver; its inputs may change between restarts, its parameters must not.
  TaylorSolver(const System& system, const SolverSettings& settings)
      : system_(system),
        accuracy_(settings),
        max_step_(settings.max_step),
        nominal_(system),
        taped_(system),
        bends_(system) {}

  /// The mode in which the system goes on after its inputs were set from outside.
  Mode settle(const Instant& now) {
    if constexpr (NominalFlow<System>::known)
      if (nominal_.covers() && nominal_.goes_on(now)) return nominal_.mode();
    return system_.settle(now);
  }

  /// The state after a guard has fired.
  Instant jump(const Instant& now, int guard) {
    if constexpr (requires { System::across_surface(now.mode); })
      if (now.mode.motion != Motion::stuck && guard == System::flank_guard &&
          falls_through(series_.guard(guard), length_,
                        roundings_of_series * guard_series<0>(system_, now)[guard][0].rounding, time_resolution(now.t)))
        return {now.t, now.x, System::across_surface(now.mode), now.since};
    return system_.jump(now, guard);
  }

  /// Takes up a new state.
  void restart(const Instant& now) {
    ++count_.restarts;
    armed_.fill(false);
    end_ = now.t;
    waited_ = 0.0;
    fired_ = no_guard;
    bends_.begin(now);
    if constexpr (NominalFlow<System>::known) nominal_.begin(now);
  }

  /// Integrates to next (<= limit, past which nothing is evaluated); returns the guard that stopped it earlier, or
  /// no_guard.
  int advance(Instant& now, double next, double limit) {
    now.t = std::min(now.t, end_);  // a report within rounding of the end of a step does not move what comes next
    bool may_leap = true;
    if (next == limit && now.t < next && now.t >= end_) {
      may_leap = leap(now, limit);
      if (may_leap && now.t == limit) return no_guard;
    }
    return advance_step_by_step(now, next, limit, may_leap);
  }

  /// The formulas by which it leaps, and the tapes.
  const NominalFlow<System>& nominal() const { return nominal_; }
  TapedFlow<System>& taped() { return taped_; }
  /// Counts leaps, or steps, and restarts before them, which may have been made elsewhere by the same formulas.
  void count_leaps(long restarts, long leaps) {
    count_.restarts += restarts;
    count_.steps += leaps;
    count_.evaluations += leaps;
  }

  /// What the solver did since it was made; an evaluation is one power series of the motion.
  SolverStatistics statistics() const {
    SolverStatistics sum = count_;
    sum.guard_evaluations = search_.evaluations();
    return sum;
  }

 private:
  /// may_leap: whether a leap from now on has not been tried. Every step tries it, so that reports decide nothing.
  [[gnu::noinline]] int advance_step_by_step(Instant& now, double next, double limit, bool may_leap) {
    for (int steps = 0; !already_there(now.t, next);) {
      if (now.t >= end_) {
        if (++steps > most_steps)
          throw SolverFault(
              "more than 100000 steps to the next sample or report; the controller does not hold the "
              "drive, or reports are too far apart");
        begin_ = now;
        if (may_leap && leap(now, limit))
          there_ = now;
        else
          step(now, limit);
        may_leap = true;
      }
      now = at(std::min(next, end_));
      if (fired_ != no_guard && now.t == end_) return fired_;
    }
    if (now.t < next && next <= end_) now = at(next);  // a report was within rounding of it
    now.t = next;
    return next == end_ ? fired_ : no_guard;
  }

  /// Goes on without a search for events to the limit, or to where a formula ends, where they can vouch for it.
  bool leap(Instant& now, double limit) {
    leapt_ = Leap::none;
    bool held = false;
    if constexpr (NominalFlow<System>::known) {
      // Where they know the drive, their series cost less than a tape's.
      held = nominal_.covers() && !nominal_.load_alone_varies();
      if (held && !(may_reach(limit, now) && nominal_.leap(now, limit, accuracy_))) return false;
    }
    if (!held && !leap_by_tape(now, limit)) return false;
    leapt_ = held ? Leap::nominal : Leap::taped;
    count_leaps(0, 1);
    end_ = now.t;
    return true;
  }
  [[gnu::noinline]] bool leap_by_tape(Instant& now, double limit) {
    if constexpr (TapedFlow<System>::known) {
      taped_covers_ = taped_.covers(now);
      return taped_covers_ && may_reach(limit, now) && taped_.leap(now, limit, accuracy_);
    }
    return false;
  }
  bool may_reach(double limit, const Instant& now) const { return limit - now.t <= max_step_; }

  /// The motion at a time of the present step.
  Instant at(double t) {
    if (leapt_ != Leap::none && t == end_) return there_;
    Instant then = begin_;
    if constexpr (NominalFlow<System>::known)
      if (leapt_ == Leap::nominal) {
        nominal_.leap(then, t, accuracy_);  // what it vouched for up to the end it vouches for on the way
        return then;
      }
    then.t = t;
    const double s = t == end_ ? length_ : t - begin_.t;
    if (leapt_ == Leap::none) then.x = SeriesFlow<System>::state_after(series_, s);
    if constexpr (TapedFlow<System>::known)
      if (leapt_ == Leap::taped) then.x = taped_.state(begin_.x, t - begin_.t);
    System::keep_within_mode(then);
    return then;
  }

  /// The polynomials from now on to the first event, or to as far as they are accurate.
  void step(const Instant& now, double limit) {
    leapt_ = Leap::none;
    const double h = std::min(limit - now.t, longest_step(now));
    expand(now, h);
    count_leaps(0, 1);
    if (!std::isfinite(series_.omega[1]) || !std::isfinite(series_.omega[series_.order]))
      throw SolverFault("the acceleration is not a finite number");
    const std::optional<double> bend = next_bend(now);
    if constexpr (TapedFlow<System>::known)
      if (by_tape_) taped_.end_where_it_fails(now, bend, accuracy_, series_);
    std::array<std::size_t, System::guard_count> vanishing{};
    for (int g = 0; g < System::guard_count; ++g)
      if (!armed_[g] && !series_.positive[g]) vanishing[g] = vanishing_at_start(system_, nominal_, series_, now, g);

    // The end of the step is a double, and the step ends there exactly.
    end_ = series_.step < limit - now.t ? std::min(now.t + series_.step, limit) : limit;
    stalled_ = end_ == now.t ? stalled_ + 1 : 0;
    if (stalled_ > most_stalled) throw SolverFault("the step size fell below the resolution of time");
    // Shorter than time is resolved: the state goes on, and the clock follows. At a branch of the equations, which no
    // such step gets across, both go on by what time resolves.
    const double ulp = end_ == now.t ? std::nextafter(now.t, limit) - now.t : 0.0;
    const bool brief = end_ == now.t && value(series_.speed(), series_.step) != now.x[1];
    if (end_ == now.t && !brief) end_ = now.t + ulp;
    length_ = brief ? series_.step : end_ - now.t;
    fired_ = no_guard;
    for (int g = 0; g < System::guard_count; ++g) {
      if (series_.positive[g]) {
        armed_[g] = true;
        continue;
      }
      const RootSearch::Fall fall = armed_[g] ? search_.first_fall(series_.guard(g), length_, true)
                                    : is_undecided(vanishing[g], g)
                                        ? fall_beyond_rounding(now, g)
                                        : search_.fall_from_start(series_.guard(g), length_, vanishing[g]);
      armed_[g] = armed_[g] || fall.armed;
      if (!fall.at || (fired_ != no_guard && *fall.at >= length_)) continue;
      end_ = std::min(now.t + *fall.at, end_);
      length_ = brief ? std::min(*fall.at, length_) : end_ - now.t;
      fired_ = g;
    }
    if (bend && *bend < length_ + time_resolution(end_)) {
      // Of a bend and a guard that falls there the bend comes first: behind it the guard may be another one. What has
      // stepped behind it goes on by the equations of that side, also where the clock would not have seen it pass.
      end_ = std::min(std::max(now.t + *bend, brief ? now.t : std::nextafter(now.t, limit)), limit);
      length_ = brief ? *bend : end_ - now.t;
      end_ = std::min(end_ + bends_.hidden_for(at(end_)), limit);
      if (!brief) length_ = end_ - now.t;
      fired_ = bends_.guard;
    }
    if constexpr (System::state_size > 2) get_behind_release();
    if (!brief || (waited_ += length_) < ulp) return;
    end_ = now.t + ulp;
    waited_ = 0.0;
  }

  /// Lets a step that ends at a release end where the state itself says so: what starts is judged by that. A margin
  /// that only touches zero where another flank would carry releases nothing.
  void get_behind_release() {
    if (fired_ == no_guard || fired_ == bends_.guard || begin_.mode.motion != Motion::stuck) return;
    const double ulp = std::nextafter(end_, std::numeric_limits<double>::infinity()) - end_;
    for (int tries = 0; tries < 8; ++tries) {
      const auto left = system_.guards_ahead(at(end_))[fired_];
      if (!(left[0] >= 0.0)) return;
      if (left[1] > 0.0) fired_ = bends_.guard;  // it comes back on the other side of a bend
      if (left[1] >= 0.0) return;
      length_ += std::max(ulp, 2.0 * left[0] / -left[1]);
      end_ = begin_.t + length_;
    }
  }
  /// Quantities at whose zeros the equations bend are followed by their series: these have to be theirs.
  double longest_step(const Instant& now) {
    if (bends_.none()) return max_step_;
    const double rate = std::max(fastest_change(system_, now), ripple_rate(system_, now.x));
    const double looks = rate > 0.0 ? phase_between_looks(false) / rate : max_step_;
    return std::min({max_step_, looks, bends_.first_step()});
  }
  void expand(const Instant& now, double h) {
    by_tape_ = false;
    if constexpr (NominalFlow<System>::known)
      if (nominal_.covers()) return nominal_.expand(now, h, accuracy_, series_);
    by_tape_ = taped_covers_;
    if constexpr (TapedFlow<System>::known)
      if (by_tape_) return taped_.expand(now, h, accuracy_, series_);  // as where the leap was tried
    flow_.expand(system_, now, h, accuracy_, series_);
  }
  /// The first bend within the series.
  std::optional<double> next_bend(const Instant& now) {
    if (bends_.none()) return std::nullopt;
    const double step = series_.step + time_resolution(now.t + series_.step);
    return bends_.first_within(bends(), series_.order, step, search_);
  }
  std::vector<Coefficients> bends() {
    if constexpr (TapedFlow<System>::known)
      if (by_tape_) return taped_.bends(series_.order);
    return flow_.bends();
  }

  /// Whether nothing decides what a guard does just after the start of a segment; a motion that has no speed yet goes
  /// on by what is left of it, see leave_rest().
  bool is_undecided(std::size_t vanishing, int guard) const {
    return vanishing >= series_.guard(guard).size() && !(guard == System::speed_guard && System::leaves_rest(begin_));
  }
  /// When a guard that is zero to rounding falls by more than that.
  RootSearch::Fall fall_beyond_rounding(const Instant& now, int guard) {
    Coefficients c = series_.guards[guard];
    c[0] += guard_start(system_, now, guard, c).floor;
    if (!(c[0] > 0.0)) return {};  // it stays at zero
    return {search_.first_fall({c.data(), series_.guard(guard).size()}, length_, true).at, false};
  }

  static constexpr int most_stalled = 1000, most_steps = 100'000;

  const System& system_;
  TaylorAccuracy accuracy_;
  double max_step_;
  NominalFlow<System> nominal_;
  TapedFlow<System> taped_;
  SeriesFlow<System> flow_;
  BendWatch<System> bends_;
  typename SeriesFlow<System>::Motion series_;
  Instant begin_{};            ///< of the present step
  double end_ = 0.0;           ///< of the present step [s] ...
  double length_ = 0.0;        ///< ... and how far it goes, which may be less than time resolves [s]
  double waited_ = 0.0;        ///< how long the clock has stood [s]
  bool taped_covers_ = false;  ///< the moment at which the latest leap was tried
  bool by_tape_ = false;       ///< series_ is
  enum class Leap { none, nominal, taped };
  Leap leapt_ = Leap::none;  ///< the step is a leap to there_; else series_ describes it
  Instant there_{};
  int fired_ = no_guard;  ///< the guard that falls through zero at the end
  RootSearch search_;
  std::array<bool, System::guard_count> armed_{};
  int stalled_ = 0;
  SolverStatistics count_{};
};

}  // namespace wormdrive
