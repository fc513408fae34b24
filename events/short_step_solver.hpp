#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "events/simulation_failure.hpp"
#include "events/solver_settings.hpp"
#include "events/taylor/polynomial_root.hpp"
#include "events/timetable.hpp"

namespace wormdrive {

/// Kutta's third-order rule for steps as short as a controller's sample: three evaluations of the torque balance,
/// whatever effects are on. They make the acceleration a parabola over the step, so speed, angle and the distance to
/// the switching surface are polynomials, and an event is the first root of one. A step is halved until the parabola
/// bends the speed by less than a bound. Made for predictions from one sample to the next; long runs want another
/// solver.
template <class System>
class ShortStepSolver {
 public:
  using Instant = typename System::Instant;

  /// longest [s]: no step is longer. The system must outlive the solver; its inputs may change between restarts.
  ShortStepSolver(const System& system, double longest) : system_(system), longest_(longest) {}

  /// The mode in which the system goes on after inputs or state were set from outside. What decides it is known to the
  /// step that begins here.
  Mode settle(const Instant& now) {
    settled_.reset();
    if (now.mode.motion == Motion::stuck || now.x[1] == 0.0) return system_.settle(now);
    const Motion motion = now.x[1] > 0.0 ? Motion::forward : Motion::backward;
    const Torques torques = torques_at(now.t, now.x[0], now.x[1], motion);
    const auto flank = system_.flank_by_far(torques.sides, torques.beyond);
    if (!flank) return system_.settle(now);
    settled_ = torques;
    return {motion, *flank};
  }

  /// Forgets what settle() knows, as inputs have changed since.
  void forget() { settled_.reset(); }

  /// Takes up a new state.
  void restart(const Instant& now) {
    ++count_.restarts;
    armed_ = {now.x[1] != 0.0, false};
    end_ = now.t;
  }

  /// Integrates to next (<= limit, past which nothing is evaluated); returns the guard that stopped it earlier, or
  /// no_guard.
  int advance(Instant& now, double next, double limit) {
    while (!already_there(now.t, next)) {
      if (now.t >= end_) step(now, limit);
      now = at(std::min(next, end_));
      if (fired_ != no_guard && now.t == end_) return fired_;
    }
    now.t = next;
    return no_guard;
  }

  /// What the solver did since it was made; an evaluation is one of the torque balance.
  const SolverStatistics& statistics() const { return count_; }

 private:
  /// What bends within a step may change the speed by at most this [rad/s]; a smaller share of it is the error.
  static constexpr double most_bend = 1e-4;
  static constexpr double shortest_share = 1.0 / 64.0;

  struct Torques {
    Moment<double> moment;
    typename System::template SideTorques<double> sides;
    double beyond;
  };
  Torques torques_at(double t, double theta_g, double omega_g, Motion motion) {
    ++count_.evaluations;
    const Moment<double> moment = system_.moment(t, theta_g, omega_g);
    const auto sides = system_.side_torques(moment, motion);
    return {moment, sides, system_.beyond_surface(sides, moment)};
  }
  bool knows(const Instant& now) const {
    if (!settled_) return false;
    const Moment<double>& at = settled_->moment;
    return at.t == now.t && at.theta_g == now.x[0] && at.omega_g == now.x[1];
  }
  struct Node {
    double acceleration, beyond;
  };
  Node node(const Torques& t) const { return {system_.acceleration(t.sides, t.moment, begin_.mode), t.beyond}; }
  Node node(double t, double theta_g, double omega_g) {
    return node(torques_at(t, theta_g, omega_g, begin_.mode.motion));
  }

  /// The polynomials from now on to the first event or to the end of the step.
  void step(const Instant& now, double limit) {
    begin_ = now;
    const double most = std::min(limit - now.t, longest_), x = now.x[0], v = now.x[1];
    const Node first = knows(now) ? node(*settled_) : node(now.t, x, v);
    const double a0 = first.acceleration;
    for (double h = most;; h *= 0.5) {
      const Node middle = node(now.t + 0.5 * h, x + 0.5 * h * (v + 0.25 * h * a0), v + 0.5 * h * a0);
      const double a1 = middle.acceleration;
      const Node last = node(now.t + h, x + h * (v + 0.5 * h * a1), v + h * (2.0 * a1 - a0));
      const double a2 = last.acceleration, bend = a0 - 2.0 * a1 + a2;
      if (!std::isfinite(bend)) throw SolverFault("the acceleration is not a finite number");
      if (h * std::abs(bend) > most_bend && h > shortest_share * most) continue;
      length_ = h;
      a_ = {a0, -3.0 * a0 + 4.0 * a1 - a2, 2.0 * bend};
      end_ = h < limit - now.t ? now.t + h : limit;
      ++count_.steps;
      find_events(first.beyond, middle.beyond, last.beyond);
      return;
    }
  }

  /// Ends the step at the first fall of a guard through zero. Coefficients of Bernstein that are all positive prove
  /// that there is none.
  void find_events(double b0, double b1, double b2) {
    fired_ = no_guard;
    const double h = length_, v = begin_.x[1], motion = sign(begin_.mode.motion);
    const double third = motion * (v + h * a_[0] / 3.0);
    const double last = motion * (v + h * (a_[0] + 0.5 * a_[1] + a_[2] / 3.0));
    const double two_thirds = last - motion * h * (a_[0] + a_[1] + a_[2]) / 3.0;
    if (!(motion * v >= 0.0 && third > 0.0 && two_thirds > 0.0 && last > 0.0)) {
      const double begin = armed_[0] ? motion * v : 0.0;
      fall(System::speed_guard,
           std::array{begin, motion * a_[0], 0.5 * motion * a_[1] / h, motion * a_[2] / (3.0 * h * h)});
    }
    armed_[System::speed_guard] = true;
    if (begin_.mode.flank == Flank::none) return;
    const double side = -static_cast<double>(sign(begin_.mode.flank));
    const double g0 = side * b0, g2 = side * b2, control = side * (2.0 * b1 - 0.5 * (b0 + b2));
    if (!(g0 > 0.0 && control > 0.0 && g2 > 0.0))
      fall(System::flank_guard, std::array{g0, 2.0 * (control - g0) / h, (g0 - 2.0 * control + g2) / (h * h)});
    else
      armed_[System::flank_guard] = true;
  }

  template <std::size_t N>
  void fall(int guard, const std::array<double, N>& polynomial) {
    const RootSearch::Fall found = search_.first_fall(polynomial, length_, armed_[guard]);
    armed_[guard] = armed_[guard] || found.armed;
    if (!found.at || begin_.t + *found.at >= end_) return;
    end_ = begin_.t + *found.at;
    fired_ = guard;
  }

  /// The motion at a time of the present step.
  Instant at(double t) const {
    const double s = t - begin_.t, p = s / length_;
    Instant then = begin_;
    then.t = t;
    then.x[0] += s * (begin_.x[1] + s * (0.5 * a_[0] + p * (a_[1] / 6.0 + p * a_[2] / 12.0)));
    then.x[1] += s * (a_[0] + p * (0.5 * a_[1] + p * a_[2] / 3.0));
    return then;
  }

  const System& system_;
  double longest_;
  Instant begin_{};            ///< of the present step
  double end_ = 0.0;           ///< of the present step, at an event if there is one [s]
  double length_ = 0.0;        ///< of the parabola [s]
  std::array<double, 3> a_{};  ///< acceleration over the share of the step [rad/s^2]
  int fired_ = no_guard;       ///< the guard that falls through zero at the end
  std::array<bool, 2> armed_{};
  std::optional<Torques> settled_;  ///< in the direction of the speed
  RootSearch search_;
  SolverStatistics count_{};
};

}  // namespace wormdrive
