#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>

#include "core/worm_drive.hpp"
#include "events/taylor/input.hpp"
#include "events/taylor/leap.hpp"
#include "events/taylor/series.hpp"
#include "events/taylor/tape_series.hpp"

namespace wormdrive {

/// Systems whose equations are recorded on tapes; here none.
template <class System>
class TapedFlow {
 public:
  static constexpr bool known = false;
  explicit TapedFlow(const System&) {}
};

/// The motion of a worm drive with any effects by its own equations, recorded once in each mode: what SeriesFlow finds,
/// many times faster.
template <class Load>
class TapedFlow<WormDrive<double, Load>> {
 public:
  static constexpr bool known = true;
  using System = WormDrive<double, Load>;
  using Instant = typename System::Instant;
  using Motion = Expansion<System::guard_count>;

  /// The system must outlive the flow; its inputs may change between steps, its parameters must not.
  explicit TapedFlow(const System& system)
      : system_(system),
        changes_(std::isfinite(system.effects().next_knot(-std::numeric_limits<double>::infinity()))) {}

  /// False where equations in this mode cannot be recorded.
  bool covers(Mode mode) {
    if (changes_) return false;
    const int at = (sign(mode.motion) > 0 ? 3 : 0) + sign(mode.flank) + 1;
    course_ = courses_[static_cast<std::size_t>(at)].get();
    if (course_ == nullptr) [[unlikely]]
      course_ = (courses_[static_cast<std::size_t>(at)] = std::make_unique<Course>(system_, mode)).get();
    return course_->series.has_value();
  }

  /// One step to next in a mode that is covered, if it is certain beforehand that no guard falls through zero in it and
  /// how far the series must go; otherwise nothing changes.
  bool leap(Instant& now, double next, const TaylorAccuracy& accuracy) {
    const double h = next - now.t;
    start(now);
    course_->series->work_out(0, course_->tape.steps().size());
    terms_ = terms_over(now, h, accuracy);
    if (terms_ == 0) return false;
    if (!inputs_are_constant()) expand_inputs(now.t, longest);
    Coefficients &theta = input(angle), &omega = input(speed);
    const Coefficients& acceleration = (*course_->series)[course_->acceleration];
    for (int k = 0;; ++k) {
      theta[k + 1] = omega[k] * reciprocal[k + 1];
      omega[k + 1] = acceleration[k] * reciprocal[k + 1];
      if (k + 1 == terms_) break;
      course_->series->work_out(k + 1, course_->operations);
    }
    theta[terms_ + 1] = omega[terms_] * reciprocal[terms_ + 1];
    now.x = state(h);
    now.t = next;
    return true;
  }
  /// Angle and speed so many seconds after the latest leap began.
  typename System::State state(double s) const {
    const std::size_t n = static_cast<std::size_t>(terms_);
    return {value({input(angle).data(), n + 2}, s), value({input(speed).data(), n + 1}, s)};
  }

  /// The motion from now on in a mode that is covered, accurate over a step of at most h.
  void expand(const Instant& now, double h, const TaylorAccuracy& accuracy, Motion& e) {
    // the next piece of a table may begin where the step does
    if (course_->has_table) return SeriesFlow<System>::expand(system_, now, h, accuracy, e);
    const int last = accuracy.order();
    start(now);
    if (!inputs_are_constant()) expand_inputs(now.t, highest_order);
    const Coefficients& acceleration = (*course_->series)[course_->acceleration];
    e.theta[0] = now.x[0];
    e.omega[0] = now.x[1];
    double allowed = accuracy.allowed(e.omega[0], h), power = 1.0 / h;  // power: h^(k-1)
    bool suffices = false;
    for (int k = 0;; ++k) {
      input(angle)[k] = e.theta[k];
      input(speed)[k] = e.omega[k];
      course_->series->work_out(k, course_->tape.steps().size());
      if (k == last) break;
      if (k >= TaylorAccuracy::least_order && std::abs(e.omega[k]) * power <= allowed) {
        complete(now.mode, k, e);
        suffices = accuracy.suffices(e, h);
        if (suffices) break;
        // a guard is near its root, and has to be exact to rounding; the speed has to be before it can be
        allowed = std::min(allowed, TaylorAccuracy::rounding_of(e.speed(), h) / h);
      }
      power *= h;
      e.theta[k + 1] = e.omega[k] * reciprocal[k + 1];
      e.omega[k + 1] = acceleration[k] * reciprocal[k + 1];
    }
    e.step = h;
    if (!suffices) {
      complete(now.mode, last, e);
      e.step = accuracy.step(e, h);
    }
    if (course_->has_exponential) SeriesFlow<System>::end_where_it_fails(system_, now, accuracy, e);
  }

 private:
  static constexpr int longest = 12;        ///< coefficients of the acceleration in a leap
  static constexpr double farthest = 64.0;  ///< leaps that the disc of times is wide

  /// Places of the inputs.
  enum Input { time, angle, speed, command, load, disturbance, inputs };

  /// The equations in one mode.
  struct Course {
    Tape tape{inputs};
    std::optional<TapeSeries> series;  ///< nothing where the equations could not be recorded
    int acceleration{}, beyond{};      ///< places
    std::size_t operations{};          ///< up to the acceleration
    bool has_exponential = false;      ///< of what moves: its terms may be too small to be seen at first
    bool has_table = false;
    bool moves = false;  ///< inputs have more than a value

    Course(const System& system, Mode mode) {
      using Side = typename System::template SideTorques<Taped>;
      const auto at = system.moment(tape.input(time), tape.input(angle), tape.input(speed));
      const Taped motor = system.effects().motor_torque(tape.input(command), at);
      const Side tau =
          system.with_bearings(Side{motor + tape.input(disturbance), load_torque(system, at, mode)}, at, mode.motion);
      acceleration = tape.place(system.acceleration(tau, at, mode));
      operations = tape.steps().size();
      beyond = tape.place(system.beyond_surface(tau, at));
      for (const Tape::Step& s : tape.steps()) {
        has_exponential = has_exponential || s.operation == Tape::Operation::exponential;
        has_table = has_table || s.operation == Tape::Operation::table;
      }
      if (!tape.is_complete()) return;
      series.emplace(tape);
      (*series)[time][1] = 1.0;
    }

   private:
    /// A load of which the functions of time are an input.
    struct Given {
      const Load& all;
      Taped over_time;
      Taped torque(const Moment<Taped>& at, wormdrive::Motion motion) const {
        if constexpr (requires { all.torque(over_time, at, motion); })
          return all.torque(over_time, at, motion);
        else
          return over_time;
      }
    };
    Taped load_torque(const System& system, const Moment<Taped>& at, Mode mode) {
      if (over_time(system.load()) == nullptr) return system.effects().load_torque(system.load(), at, mode.motion);
      return system.effects().load_torque(Given{system.load(), tape.input(load)}, at, mode.motion);
    }
  };

  Coefficients& input(Input which) { return (*course_->series)[which]; }
  const Coefficients& input(Input which) const { return (*course_->series)[which]; }

  /// What of a load depends on time alone, or nullptr.
  static const TimedLoad* over_time(const Load& load) {
    if constexpr (requires { load.over_time(); })
      return load.over_time();
    else
      return nullptr;
  }
  const Piece* load_piece() const {
    const TimedLoad* const timed = over_time(system_.load());
    return timed == nullptr ? nullptr : &timed->piece;
  }
  bool inputs_are_constant() const {
    const Piece* const piece = load_piece();
    return system_.motor_input().is_constant() && (piece == nullptr || piece->is_constant());
  }
  /// The values of the inputs.
  void start(const Instant& now) {
    input(time)[0] = now.t;
    input(angle)[0] = now.x[0];
    input(speed)[0] = now.x[1];
    input(command)[0] = system_.motor_input()(now.t);
    input(disturbance)[0] = system_.disturbance();
    if (const Piece* const piece = load_piece()) input(load)[0] = (*piece)(now.t);
    if (!course_->moves) return;
    std::fill(input(command).begin() + 1, input(command).end(), 0.0);
    std::fill(input(load).begin() + 1, input(load).end(), 0.0);
    course_->moves = false;
  }
  /// The series of those that change on their own.
  void expand_inputs(double t, int order) {
    const auto motor = system_.motor_input()(OpenSeries<double>::variable(t, order));
    std::copy(motor.c.begin(), motor.c.end(), input(command).begin());
    if (const Piece* const piece = load_piece()) expand_input(*piece, t, order, 1.0, input(load));
    course_->moves = true;
  }

  /// How many coefficients of the acceleration a step of h needs; 0 if a guard might fall in it, or if it takes more
  /// than there are.
  ///
  /// Around the present moment there is a disc of complex times in which angle and speed stay in discs of theirs, and
  /// so nothing strays from its value f by more than some r. What is so bounded in a disc of a radius R differs from f
  /// by at most r |s|/R at a time s (Schwarz), and its k-th coefficient is at most r/R^k (Cauchy).
  int terms_over(const Instant& now, double h, const TaylorAccuracy& accuracy) {
    TapeSeries& series = *course_->series;
    const double omega = now.x[1], v = std::abs(omega), alpha = series[course_->acceleration][0];
    const double motion = sign(now.mode.motion), flank = sign(now.mode.flank);
    // Radii with which both angle and speed use up theirs at about the same time.
    const double ripple = system_.ripple();
    series.radius(angle) = ripple > 0.0 ? TapeSeries::widest / ripple : 1.0;
    series.radius(speed) = std::max(0.5 * (std::sqrt(v * v + 4.0 * series.radius(angle) * std::abs(alpha)) - v),
                                    series.radius(angle) / (4.0 * farthest * h));
    series.radius(time) = farthest * h;
    series.radius(command) = series.radius(load) = series.radius(disturbance) = 0.0;
    if (!inputs_are_constant()) {
      series.radius(time) = std::min(series.radius(time), 1.0 / system_.fastest_input(now.t));
      series.radius(command) = system_.motor_input().change_within(now.t, series.radius(time));
      if (const Piece* const piece = load_piece()) series.radius(load) = piece->change_within(series.radius(time));
    }
    series.work_out_discs();
    if (const double factor = series.shrinking(); !(factor >= 1.0)) {
      for (const Input which : {time, angle, speed, command, load}) series.radius(which) *= (1.0 - 1e-6) * factor;
      series.work_out_discs();
      if (!(series.shrinking() >= 1.0)) return 0;
    }
    const double strays = series.radius(course_->acceleration);
    const double disc = std::min({series.radius(speed) / (above_one * (std::abs(alpha) + strays)),
                                  series.radius(angle) / (v + series.radius(speed)), series.radius(time)});
    const double ratio = above_one * h / disc;
    if (!(ratio <= 0.5)) return 0;

    const double bend = strays * ratio, change = above_one * (std::abs(alpha) + bend) * h, along = motion * omega;
    if (!(along > change || (along >= 0.0 && motion * alpha > bend))) return 0;
    if (flank != 0.0 && !(-flank * series[course_->beyond][0] > series.radius(course_->beyond) * ratio)) return 0;
    bool within = true;
    series.for_each_range([&](const TapeSeries::Range& r) {
      const double x = series[r.place][0], nearing = series.radius(r.place) * ratio;
      within = within && x - nearing > r.low && x + nearing < r.high;
    });
    if (!within) return 0;

    const double allowed = accuracy.allowed(v + change, h) * (1.0 - ratio);
    double error = bend;  // of the acceleration
    for (int terms = 1; terms <= longest; ++terms, error *= ratio)
      if (error * reciprocal[terms + 1] <= allowed) return terms;
    return 0;
  }

  /// Angle and guards to the order to which the speed is known.
  void complete(Mode mode, int order, Motion& e) const {
    e.order = order;
    const Coefficients& beyond = (*course_->series)[course_->beyond];
    const double motion = sign(mode.motion), side = -sign(mode.flank);
    e.theta[order + 1] = e.omega[order] * reciprocal[order + 1];
    for (int k = 0; k <= order; ++k) {
      e.guards[System::speed_guard][k] = motion * e.omega[k];
      e.guards[System::flank_guard][k] = side * beyond[k];
    }
    if (mode.flank == Flank::none) e.guards[System::flank_guard][0] = 1.0;
  }
  const System& system_;
  bool changes_;  ///< an effect is another one from a given time on
  std::array<std::unique_ptr<Course>, 6> courses_;
  Course* course_ = nullptr;  ///< of the latest mode
  int terms_ = 0;             ///< of the latest leap
};

}  // namespace wormdrive
