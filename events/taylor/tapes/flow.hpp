#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/worm_drive.hpp"
#include "events/taylor/input.hpp"
#include "events/taylor/polynomial_root.hpp"
#include "events/taylor/series.hpp"
#include "events/taylor/tapes/leap.hpp"

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
      : system_(system), changes_(std::isfinite(system.effects().next_knot(-never))) {}

  /// False where equations in this mode cannot be recorded.
  bool covers(Mode mode) {
    if (changes_) return false;
    const int at = (sign(mode.motion) > 0 ? 3 : 0) + sign(mode.flank) + 1;
    course_ = courses_[static_cast<std::size_t>(at)].get();
    if (course_ == nullptr) [[unlikely]]
      course_ = (courses_[static_cast<std::size_t>(at)] = std::make_unique<Course>(system_, mode)).get();
    return course_->leap.has_value();
  }

  /// One step in a mode that is covered, to next or to where a section of a table ends, if it is certain beforehand
  /// that no guard falls through zero in it and how far the series must go; otherwise nothing changes.
  bool leap(Instant& now, double next, const TaylorAccuracy& accuracy) {
    const double h = next - now.t;
    begin(now);
    const MotorInput<double>& motor = system_.motor_input();
    const auto command_disc = [&](double seconds) { return motor.change_within(now.t, seconds); };
    CommandReach<double> reach{never, never, TapedLeap::farthest};
    if (motor.lags()) reach = reach_of_lag(motor.lag(), now.t - motor.arrival());
    reach.disc = std::min(reach.disc, 1.0 / motor.piece().fastest());
    double end = h;
    // where sections of a table are short, a step would end with them, too
    const double part = course_->code.sections > 0 ? 0x1p-10 : TapedLeap::worth_while;
    if (!course_->leap->foresee(true, end, part, accuracy, reach, command_disc)) return false;
    course_->leap->follow(course_->tables);
    if (!course_->leap->end_with_sections(true, end) || !(now.t + end > now.t)) return false;
    now.x = state(end);
    now.t = end < h ? now.t + end : next;
    return true;
  }
  /// Angle and speed so many seconds after the latest leap began.
  typename System::State state(double s) const {
    return {course_->leap->angle_after(s), course_->leap->speed_after(s)};
  }

  // ---- for lanes -----------------------------------------------------------------------------------------------

  /// The operations in a mode; nullptr where its equations cannot be recorded.
  const TapeCode* code(Mode mode) { return covers(mode) ? &course_->code : nullptr; }
  /// The numbers of the latest mode and of the inputs that hold until they become others [s].
  const double* numbers(double next_knot) {
    read_inputs();
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

  /// The motion from now on in a mode that is covered, accurate over a step of at most h.
  void expand(const Instant& now, double h, const TaylorAccuracy& accuracy, Motion& e) {
    const int last = accuracy.order();
    TapeSeriesOf<double>& series = course_->leap->series();
    begin(now);
    h = std::min(h, course_->leap->longest_within_sections());
    course_->leap->expand_load(last);
    const double* const acceleration = series[series.code().acceleration];
    e.theta[0] = now.x[0];
    e.omega[0] = now.x[1];
    double allowed = accuracy.allowed(e.omega[0], h), power = 1.0 / h;  // power: h^(k-1)
    bool suffices = false;
    for (int k = 0;; ++k) {
      series[In::angle][k] = e.theta[k];
      series[In::speed][k] = e.omega[k];
      if (k > 0) series.work_out(k, series.code().operations, course_->tables);
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
    for (int k = 0; k < series.code().sections; ++k)
      e.step = std::min(e.step, end_of_section(series.section(k), series[series.code().arguments[k]], e));
    if (course_->has_exponential) SeriesFlow<System>::end_where_it_fails(system_, now, accuracy, e);
  }

 private:
  using TapedLeap = TapedLeapOf<double>;
  static constexpr double never = std::numeric_limits<double>::infinity();
  using In = TapeInput;

  /// The equations in one mode.
  class Course {
   public:
    Course(const System& system, Mode mode) {
      using Side = typename System::template SideTorques<Taped>;
      const auto at = system.moment(tape_.input(In::time), tape_.input(In::angle), tape_.input(In::speed));
      const Taped motor = system.effects().motor_torque(tape_.input(In::command), at);
      const Side tau = system.with_bearings(Side{motor + tape_.input(In::disturbance), load_torque(system, at, mode)},
                                            at, mode.motion);
      code.acceleration = tape_.place(system.acceleration(tau, at, mode));
      code.of_acceleration = static_cast<int>(tape_.steps().size());
      code.beyond = tape_.place(system.beyond_surface(tau, at));
      code.worm = tape_.place(tau.worm);
      code.gear = tape_.place(tau.gear);
      if (!tape_.is_complete()) return;
      has_exponential = !tape_.exponents().empty();
      for (const Tape::Condition& c : tape_.conditions()) bounded_.push_back(c.place);
      code.steps = tape_.steps().data();
      code.operations = static_cast<int>(tape_.steps().size());
      code.places = tape_.places();
      code.bounded = bounded_.data();
      code.arguments = tape_.arguments().data();
      code.bounds = static_cast<int>(bounded_.size());
      code.sections = static_cast<int>(tape_.arguments().size());
      code.lags = system.motor_input().lags();
      if (const TimedLoad* const timed = over_time(system.load()))
        code.waves = static_cast<int>(timed->signal.terms.size());
      memory.assign(TapeSeriesOf<double>::room(code, stride), 0.0);
      leap.emplace(TapeSeriesOf<double>(code, memory.data(), stride));
      TapeSeriesOf<double>& series = leap->series();
      for (std::size_t k = 0; k < tape_.steps().size(); ++k)
        series.line(static_cast<int>(k)) = {tape_.steps()[k].factor, tape_.steps()[k].offset};
      for (std::size_t k = 0; k < bounded_.size(); ++k)
        series.least_of(static_cast<int>(k)) = tape_.conditions()[k].least;
      TapedMotionOf<double>& motion = series.motion();
      motion.motion = sign(mode.motion);
      motion.flank = sign(mode.flank);
      motion.surface = system.surface();
      const double ripple = system.ripple();
      motion.angle_disc = ripple > 0.0 ? TapeSeriesOf<double>::widest / ripple : 1.0;
      tables = TapeTables(tape_, series);
    }
    Course(const Course&) = delete;  // what is in it points to the rest
    Course& operator=(const Course&) = delete;

    TapeCode code;
    std::vector<double> memory;
    std::optional<TapedLeap> leap;  ///< nothing where the equations could not be recorded
    TapeTables tables;
    bool has_exponential = false;  ///< of what moves: its terms may be too small to be seen at first
    bool command_moves = false;    ///< the series of the command has more than a value

   private:
    static constexpr int stride = highest_order + 2;  ///< a search for events takes the longest series

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
      return system.effects().load_torque(Given{system.load(), tape_.input(In::load)}, at, mode.motion);
    }

    Tape tape_{In::count};
    std::vector<int> bounded_;
  };

  /// What of a load depends on time alone, or nullptr.
  static const TimedLoad* over_time(const Load& load) {
    if constexpr (requires { load.over_time(); })
      return load.over_time();
    else
      return nullptr;
  }

  void begin(const Instant& now) {
    read_inputs();
    expand_command(now.t);
    course_->leap->begin(now.t, now.x[0], now.x[1], system_.motor_input()(now.t), system_.disturbance(),
                         course_->tables);
  }
  /// The inputs that hold now.
  void read_inputs() {
    TapedMotionOf<double>& m = course_->leap->series().motion();
    const TimedLoad* const timed = over_time(system_.load());
    m.time_disc = never;
    if (timed == nullptr) return;
    const Piece& piece = timed->piece;
    m.time_disc = 1.0 / piece.fastest();
    m.load = piece.constant;
    m.slope = piece.slope;
    m.start = piece.start;
    m.steepness = m.fastest = 0.0;
    for (int k = 0; k < course_->code.waves; ++k) {
      const bool holds = static_cast<std::size_t>(k) < piece.cosines.size();
      const Cosine wave = holds ? piece.cosines[static_cast<std::size_t>(k)] : Cosine{0.0, 0.0, 0.0};
      course_->leap->series().wave(k) = {wave.amplitude, wave.omega, wave.phase, {}};
      m.steepness += std::abs(wave.amplitude * wave.omega);
      m.fastest = std::max(m.fastest, std::abs(wave.omega));
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

  /// Angle and guards to the order to which the speed is known.
  void complete(Mode mode, int order, Motion& e) const {
    e.order = order;
    const double* const beyond = course_->leap->series()[course_->code.beyond];
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
  RootSearch search_;         ///< of the ends of sections
};

}  // namespace wormdrive
