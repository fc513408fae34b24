#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "events/taylor/input.hpp"
#include "events/taylor/polynomial_root.hpp"
#include "events/taylor/series.hpp"
#include "events/taylor/tapes/course.hpp"

namespace wormdrive {

/// Systems whose equations are recorded on tapes; here none.
template <class System>
class TapedFlow {
 public:
  static constexpr bool known = false;
  explicit TapedFlow(const System&) {}
};

/// The motion of a worm drive with any effects by its own equations, recorded in each mode once for every way in which
/// comparisons turn out: what SeriesFlow finds, many times faster.
template <class Load, bool with_states>
class TapedFlow<WormDrive<double, Load, with_states>> {
 public:
  static constexpr bool known = true;
  using System = WormDrive<double, Load, with_states>;
  using Instant = typename System::Instant;
  using Motion = Expansion<System::guard_count, System::state_size - 2>;

  /// The system must outlive the flow; its inputs may change between steps, its parameters must not.
  explicit TapedFlow(const System& system) : system_(system) {}

  /// False where the equations that hold now cannot be recorded.
  bool covers(const Instant& now) {
    if (now.mode.motion == wormdrive::Motion::stuck) return false;
    const int at = (sign(now.mode.motion) > 0 ? 3 : 0) + sign(now.mode.flank) + 1;
    std::vector<std::unique_ptr<Course>>& known_ones = courses_[static_cast<std::size_t>(at)];
    for (auto& course : known_ones)
      if (takes_up(*course, now)) {
        std::swap(course, known_ones.front());
        return true;
      }
    if (known_ones.size() == most_ways) return false;
    auto course = std::make_unique<Course>(system_, now.mode, now);
    if (!course->leap) return false;
    known_ones.push_back(std::move(course));
    return takes_up(*known_ones.back(), now);
  }
  /// One step from the moment that was covered last, to next or to where its series or a section of a table ends, if it
  /// is certain that no guard falls through zero in it; otherwise nothing changes.
  bool leap(Instant& now, double next, const TaylorAccuracy& accuracy) {
    const double h = next - now.t;
    double end = h;
    LeapByTerms<double> by_terms(*course_->leap);
    const bool certain = by_terms.take(true, end, accuracy, course_->tables);
    worked_out_ = by_terms.worked_out();
    if (!certain) return false;
    if (!course_->leap->end_with_sections(true, end) || !(now.t + end > now.t)) return false;
    now.x = state(now.x, end);
    now.t = end < h ? now.t + end : next;
    return true;
  }
  /// The state so many seconds after the latest leap began, in one.
  typename System::State state(typename System::State x, double s) const {
    x[0] = course_->leap->angle_after(s);
    x[1] = course_->leap->speed_after(s);
    for (std::size_t k = 0; k < states().size(); ++k)
      x[static_cast<int>(2 + states()[k])] = course_->leap->state_after(static_cast<int>(k), s);
    return x;
  }

  // ---- for lanes -----------------------------------------------------------------------------------------------

  /// The operations of the equations that hold now; nullptr where they cannot be recorded.
  const TapeCode* code(const Instant& now) { return covers(now) ? &course_->code : nullptr; }
  /// Which states of effects they have, by their places among all.
  const std::vector<std::size_t>& states() const { return course_->states(); }
  /// The numbers of the moment that was covered last, and of the inputs that hold until they become others [s].
  const double* numbers(double next_knot) {
    TapedMotionOf<double>& m = course_->leap->series().motion();
    m.next_knot = next_knot;
    m.leaps = 0.0;
    return course_->memory.data();
  }
  /// The section of a table in the latest mode.
  SectionOf<double> section(int number, double x) {
    course_->tables.find(number, x);
    return course_->leap->series().section(number);
  }

  /// The motion from the moment on that was covered last, accurate over a step of at most h.
  void expand(const Instant& now, double h, const TaylorAccuracy& accuracy, Motion& e) {
    const int last = accuracy.order();
    TapedLeap& leap = *course_->leap;
    TapeSeriesOf<double>& series = leap.series();
    h = std::min(h, leap.longest_within_sections());
    leap.expand_load(1, last);
    const double* const omega = series[In::speed];
    double allowed = accuracy.allowed(now.x[1], h), power = 1.0 / h;  // power: h^(k-1)
    bool suffices = false;
    for (int k = 0;; ++k) {
      if (k >= worked_out_) series.work_out(k, series.code().operations, course_->tables);
      leap.expand_motion(k);
      if (k == last) break;
      if (k >= TaylorAccuracy::least_order && std::abs(omega[k]) * power <= allowed) {
        complete(now, k, e);
        suffices = accuracy.suffices(e, h);
        if (suffices) break;
        // a guard is near its root, and has to be exact to rounding; the speed has to be before it can be
        allowed = std::min(allowed, TaylorAccuracy::rounding_of(e.speed(), h) / h);
      }
      power *= h;
    }
    e.step = h;
    if (!suffices) {
      complete(now, last, e);
      e.step = accuracy.step(e, h);
    }
    for (int k = 0; k < series.code().sections; ++k)
      e.step = std::min(e.step, end_of_section(series.section(k), series[series.code().arguments[k]], e));
    const std::span exponents(series.code().exponents, static_cast<std::size_t>(series.code().exponentials));
    e.step = end_of_rise(series, exponents, e.order, e.step, search_);
  }
  /// Ends the step that was expanded last where its equations become others, unless that is at its first bend [s],
  /// where it ends anyway.
  void end_where_it_fails(const Instant& now, const std::optional<double>& bend, const TaylorAccuracy& accuracy,
                          Motion& e) {
    if (LeapByTerms<double>(*course_->leap).keeps_sides(e.step, e.order + 1)) return;
    if (bend && keeps_sides_until(*bend - time_resolution(now.t + *bend), e)) return;
    SeriesFlow<System>::end_where_it_fails(system_, now, accuracy, e);
  }
  /// The quantities at whose zeros the equations bend, along the motion that was expanded last.
  std::vector<Coefficients> bends(int order) const {
    std::vector<Coefficients> all(course_->bends().size(), Coefficients{});
    for (std::size_t k = 0; k < all.size(); ++k) put(course_->bends()[k], order, all[k]);
    return all;
  }

 private:
  using Course = TapeCourse<System>;
  using TapedLeap = TapedLeapOf<double>;
  static constexpr double never = std::numeric_limits<double>::infinity();
  using In = TapeInput;

  /// So many ways in which comparisons turn out in a mode are kept; behind them a drive goes on without leaps.
  static constexpr std::size_t most_ways = 16;

  /// Takes up a moment, and returns whether the equations of a course hold there.
  bool takes_up(Course& course, const Instant& now) {
    course_ = &course;
    begin(now);
    return LeapByTerms<double>(*course.leap).holds();
  }

  /// Whether no comparison turns out otherwise before s, within the step.
  bool keeps_sides_until(double s, const Motion& e) {
    const TapeSeriesOf<double>& series = course_->leap->series();
    const int last = e.order;
    for (int k = 0; k < series.code().comparisons; ++k) {
      const double* const c = series[series.code().decisions[k]];
      const auto [value, side] = series.side(k);
      Coefficients left{};  // until it turns out otherwise
      for (int j = 0; j <= last; ++j) left[j] = side * (j == 0 ? c[0] - value : c[j]);
      const auto turn = search_.first_root({left.data(), static_cast<std::size_t>(last) + 1}, e.step);
      if (turn && *turn < s) return false;
    }
    return true;
  }

  void begin(const Instant& now) {
    worked_out_ = 1;
    read_inputs();
    expand_command(now.t);
    for (std::size_t k = 0; k < states().size(); ++k)
      course_->leap->series()[In::first_state + static_cast<int>(k)][0] = now.x[static_cast<int>(2 + states()[k])];
    course_->leap->begin(now.t, now.x[0], now.x[1], system_.motor_input()(now.t), system_.disturbance(),
                         course_->tables);
  }
  /// The inputs that hold now.
  void read_inputs() {
    TapedMotionOf<double>& m = course_->leap->series().motion();
    const TimedLoad* const timed = over_time(system_.load());
    m.brake = system_.effects().braking();
    if (timed == nullptr) return;
    const Piece& piece = timed->piece;
    m.load = piece.constant;
    m.slope = piece.slope;
    m.start = piece.start;
    for (int k = 0; k < course_->code.waves; ++k) {
      const bool holds = static_cast<std::size_t>(k) < piece.cosines.size();
      const Cosine wave = holds ? piece.cosines[static_cast<std::size_t>(k)] : Cosine{0.0, 0.0, 0.0};
      course_->leap->series().wave(k) = {wave.amplitude, wave.omega, wave.phase, {}};
    }
  }
  /// The series of the motor's command, without its value.
  void expand_command(double t) {
    double* const c = course_->leap->series()[In::command];
    const bool moves = !system_.motor_input().is_constant();
    if (moves)
      expand_torque(system_.motor_input(), t, highest_order, c);
    else if (course_->command_moves)
      std::fill(c + 1, c + highest_order + 2, 0.0);
    course_->command_moves = moves;
  }

  /// How long the argument of a table stays in its section, within the step [s].
  double end_of_section(const SectionOf<double>& section, const double* x, const Motion& e) {
    double end = e.step;
    for (const double side : {1.0, -1.0}) {
      Coefficients left{};  // to the point on that side
      left[0] = side > 0.0 ? section.high - x[0] : x[0] - section.low;
      if (!std::isfinite(left[0])) continue;
      for (int k = 1; k <= e.order; ++k) left[k] = -side * x[k];
      std::size_t vanishing = std::abs(left[0]) <= resolution_of(section, x[0]) ? 1 : 0;
      while (vanishing > 0 && vanishing <= static_cast<std::size_t>(e.order) && left[vanishing] == 0.0) ++vanishing;
      const Polynomial all{left.data(), static_cast<std::size_t>(e.order) + 1};
      if (const auto met = search_.fall_from_start(all, end, vanishing).at) end = *met;
    }
    return end;
  }

  /// Motion and guards to an order, out of the series.
  void complete(const Instant& now, int order, Motion& e) const {
    const TapedLeap& leap = *course_->leap;
    const TapeSeriesOf<double>& series = leap.series();
    e.order = order;
    std::copy_n(series[In::angle], order + 1, e.theta.begin());
    std::copy_n(series[In::speed], order + 1, e.omega.begin());
    e.theta[order + 1] = e.omega[order] * reciprocal[order + 1];
    const double* const beyond = series[course_->code.beyond];
    const double motion = sign(now.mode.motion), side = -sign(now.mode.flank);
    for (int k = 0; k <= order; ++k) {
      e.guards[System::speed_guard][k] = motion * e.omega[k];
      e.guards[System::flank_guard][k] = side * beyond[k];
    }
    if (now.mode.flank == Flank::none) e.guards[System::flank_guard][0] = 1.0;
    if constexpr (with_states) {
      for (int k = 0; k < System::state_size - 2; ++k) e.states[k][0] = now.x[2 + k];
      for (std::size_t k = 0; k < states().size(); ++k)
        std::copy_n(series[In::first_state + static_cast<int>(k)], order + 1, e.states[states()[k]].begin());
      put(course_->way_to_stop(), order, e.guards[System::stop_guard]);
    }
  }
  /// Sets c to the series of a multiple of what stands in a place.
  void put(const Tape::Multiple& of, int order, Coefficients& c) const {
    const double* const series = course_->leap->series()[of.place];
    for (int k = 0; k <= order; ++k) c[k] = of.factor * series[k];
    c[0] += of.constant;
  }

  const System& system_;
  std::array<std::vector<std::unique_ptr<Course>>, 6> courses_;  ///< of each mode
  Course* course_ = nullptr;                                     ///< of the latest one
  int worked_out_ = 0;                                           ///< coefficients of all operations
  RootSearch search_;                                            ///< of the ends of sections and of rises
};

}  // namespace wormdrive
