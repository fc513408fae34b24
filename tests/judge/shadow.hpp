#pragma once
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "judge/course.hpp"

namespace judge {

/// How exactly a program follows the motion between two events.
struct Exactness {
  double relative = 1e-9;   ///< error of the speed, as a share of the highest, and of the angle, as one of the way
  double absolute = 1e-11;  ///< [rad/s]
  double time = 5e-13;      ///< of an event, as a share of its time
  double angle = 0.0;       ///< error of the angle of a gear that has moved, beside its share of the way [rad]
};

/// Follows the events that a program reports, in exact arithmetic and in the modes that the program was in, and says
/// where a mode contradicts the state by more than rounding and the program's exactness explain.
///
/// Friction makes the motion unique. So events of which none is contradicted are those of a drive whose torques differ
/// by roundings; what is missed, invented, or decided the other way contradicts the state sooner or later.
class Shadow {
 public:
  static constexpr double rounding = 64 * 2.2e-16;  ///< of a torque, as a share of the terms that it is the sum of

  /// It gives up after so many steps.
  Shadow(const Drive& drive, Exactness exactness, long most_steps = 6000)
      : course_(drive, most_steps), exactness_(exactness) {}

  /// The first contradiction in a run that begins in a mode; empty if there is none.
  std::string contradiction(Mode start, const std::vector<Event>& events) {
    mode_ = start;
    course_.enter(0.0);
    if (course_.omega != 0 && mode_.motion == 0) return "stuck at the start at a speed of " + text(course_.omega);
    for (const Event& event : events) {
      if (!(event.before == mode_)) return at("the event's mode before it is another than that after the last one");
      if (!follow(event.t)) return complaint_;
      if (!take(event)) return complaint_;
    }
    follow(course_.drive().end);
    return complaint_;
  }
  /// How many times as much as is allowed contradicts; infinite for a mode that cannot be.
  double excess() const { return excess_; }
  /// How far it is behind the last call [rad, rad/s].
  Quad theta() const { return course_.theta; }
  Quad omega() const { return course_.omega; }

 private:
  using Polynomial = EventSequence<Quad>::Polynomial;

  bool follow(double to) {
    while (course_.t < Quad(to)) {
      const double knot = course_.next_knot(), stop = std::min(knot, to);
      const Quad h = mode_.motion == 0 ? rest(stop) : move(stop);
      if (!complaint_.empty()) return false;
      course_.t = course_.t + h >= Quad(stop) ? Quad(stop) : course_.t + h;
      if (course_.t == Quad(knot)) {
        inputs_before_ = course_.entered;
        course_.enter(knot);
      }
    }
    return true;
  }

  Quad rest(double stop) {
    Quad h = Quad(stop) - course_.t;
    std::string complaint;
    for (const Quad& since : ages()) {
      course_.since = since;
      Quad end = h;
      for (int sigma : {1, -1}) end = std::min(end, course_.resting(sigma, end).step);
      complaint = pulled(end);
      if (complaint.empty()) return end;
    }
    complaint_ = complaint;
    return 0;
  }
  /// What speaks against resting for h from now on, if something does.
  std::string pulled(Quad h) {
    for (int sigma : {1, -1}) {
      auto [pull, step] = course_.resting(sigma, h);
      // free where both flanks' pulls are; the largest of the smaller one lies at an end, a turn, or where they meet
      std::vector<Quad> looks{0, h}, turns;
      Polynomial apart = pull[0];
      for (std::size_t k = 0; k < apart.size(); ++k) apart[k] -= pull[1][k];
      for (const Polynomial& c : {pull[0], pull[1]}) {
        zeros(c, h, &turns);
        looks.insert(looks.end(), turns.begin(), turns.end());
      }
      for (const Quad s : zeros(apart, h)) looks.push_back(s);
      for (const Quad s : looks) {
        const Quad free = std::min(Quad(sigma) * value(pull[0], s), Quad(sigma) * value(pull[1], s));
        const double allowed = slack(sigma, true, s, std::max(slope(pull[0], s), slope(pull[1], s))).pull;
        if (free > Quad(allowed))
          return at("stuck, though " + text(free) + " N m pull it " + (sigma > 0 ? "forward" : "backward") +
                        ", allowed " + text(allowed),
                    s);
      }
    }
    return {};
  }

  Quad move(double stop) {
    const auto ahead = course_.ahead(mode_, Quad(stop) - course_.t);
    const Quad h = ahead.step;
    way_ += std::abs(number(value(ahead.theta, h) - course_.theta));
    drift(number(h), value(ahead.theta, h), value(ahead.omega, h));
    for (const Quad s : looks(ahead.omega, h)) {
      const Quad speed = value(ahead.omega, s);
      fastest_ = std::max(fastest_, std::abs(number(speed)));
      hardest_ = std::max(hardest_, slope(ahead.omega, s));
      const double allowed = omega_slack(s) + slope(ahead.omega, s) * time_slack(s);
      if (Quad(mode_.motion) * speed < -Quad(allowed))
        return fail("moves the other way, at " + text(speed) + " rad/s", s, number(speed), allowed);
    }
    if (mode_.flank != 0)
      for (const Quad s : looks(ahead.beyond, h)) {
        const Quad beyond = value(ahead.beyond, s);
        const double allowed =
            slack(mode_.motion, false, s, slope(ahead.beyond, s), value(ahead.theta, s), value(ahead.omega, s)).beyond;
        if (Quad(mode_.flank) * beyond > Quad(allowed))
          return fail("the other flank carries, " + text(beyond) + " N m beyond the surface", s, number(beyond),
                      allowed);
      }
    course_.theta = value(ahead.theta, h);
    course_.omega = value(ahead.omega, h);
    return h;
  }

  /// What errors of angle and speed, and roundings of the torques, become within the seconds of a step: a friction that
  /// falls over the speed, or an arm that falls over, makes them grow.
  void drift(double seconds, Quad theta, Quad omega) {
    double growth = 0.0, push = 0.0;
    for (const auto& place : {std::pair{course_.theta, course_.omega}, {theta, omega}}) {
      const Quad angle = place.first, speed = place.second;
      const auto now = [&](double turned, double faster) {
        return course_.now(mode_.motion, mode_.flank, false, angle + Quad(turned), speed + Quad(faster));
      };
      const auto acceleration = [](const Outcome<Sized>& o) { return o.pull.value / o.inertia.value; };
      const Outcome<Sized> here = now(0.0, 0.0);
      const Quad a = acceleration(here);
      const double turned = theta_slack(), faster = mode_.motion * omega_error(0);
      growth = std::max(growth, number(acceleration(now(0.0, faster)) - a) / faster);
      push = std::max(push, std::abs(number(acceleration(now(turned, 0.0)) - a)) +
                                rounding * here.pull.size / std::abs(number(here.inertia.value)));
    }
    if (course_.t == began_ && growth * late_ < 1.0) late_ = 0.0;  // roundings do not grow in it: push tells of them
    const double grown = std::expm1(growth * seconds);
    theta_drift_ += omega_error(0) * seconds * (1.0 + grown);
    drift_ += omega_error(0) * grown + push * (growth > 0.0 ? grown / growth : seconds);
  }

  /// Checks an event that happens now, and takes up the mode behind it.
  bool take(const Event& event) {
    const int before = mode_.motion, after = event.after.motion;
    if (before != 0 && after != before) {
      const Outcome<Sized> now = course_.now(before, mode_.flank, false, course_.theta, course_.omega);
      const double allowed = omega_slack(0) + std::abs(number(now.pull.value / now.inertia.value)) * time_slack(0);
      if (std::abs(number(course_.omega)) > allowed) {
        fail("stops or turns at a speed of " + text(course_.omega) + " rad/s", 0, number(course_.omega), allowed);
        return false;
      }
      course_.omega = 0;
      ages_ = {course_.t};
      // of a motion that is shorter than time is known nobody can tell whether it was one
      if (course_.t - began_ <= Quad(time_slack(0))) ages_.push_back(course_.since);
      course_.since = course_.t;
      drift_ = fastest_ = hardest_ = late_ = 0.0;
    }
    if (after != 0 && after != before) {
      if (!released(after)) return false;
      began_ = course_.t;
    }
    mode_ = event.after;
    return true;
  }
  /// Whether it may start in a direction: by the inputs that hold now or, on a knot, by those before it.
  bool released(int sigma) {
    const double entered = course_.entered;
    double lack = 0.0, allowed = 0.0;
    for (const Quad& since : ages())
      for (const double inputs : {entered, course_.t == Quad(entered) ? inputs_before_ : entered}) {
        course_.entered = inputs;
        course_.since = since;
        const auto [pull, step] = course_.resting(sigma, Quad(1e-9) + Quad(1e-9) * abs(course_.t));
        lack = number(-std::min(Quad(sigma) * pull[0][0], Quad(sigma) * pull[1][0]));
        allowed = slack(sigma, true, 0, std::max(slope(pull[0], 0), slope(pull[1], 0))).pull;
        if (lack <= allowed) late_ = lateness(sigma, allowed);
        course_.entered = entered;
        if (lack <= allowed) return true;
      }
    fail("starts " + std::string(sigma > 0 ? "forward" : "backward") + ", though " + text(lack) + " N m are lacking", 0,
         lack, allowed);
    return false;
  }

  /// For how long from now on no more than an allowance pulls the gear in a direction [s].
  double lateness(int sigma, double allowed) {
    auto [pull, step] = course_.resting(sigma, Quad(course_.drive().end) - course_.t);
    Quad late = 0;
    for (Polynomial& c : pull) {
      c[0] -= Quad(sigma * allowed);
      const std::vector<Quad> ends = zeros(c, step);
      late = std::max(late, Quad(sigma) * c[0] > 0 ? Quad(0) : ends.empty() ? step : ends.front());
    }
    return number(late);
  }

  /// Since when the gear may be at rest.
  std::vector<Quad> ages() const { return ages_.empty() ? std::vector{course_.since} : ages_; }

  static std::vector<Quad> looks(const Polynomial& c, Quad h) {
    std::vector<Quad> at;
    zeros(c, h, &at);
    at.insert(at.end(), {Quad(0), h});
    return at;
  }
  static double number(Quad x) { return static_cast<double>(x); }
  static double slope(const Polynomial& c, Quad s) { return std::abs(number(value(derivative(c), s))); }

  double time_slack(Quad s) const { return exactness_.time * number(course_.t + s); }
  double omega_error(Quad s) const {
    return exactness_.absolute + exactness_.relative * fastest_ + hardest_ * (time_slack(s) + late_) + drift_;
  }
  /// What grows is followed to first order: a motion that leaves rest as slowly as it is known may come to several
  /// times as much.
  double omega_slack(Quad s) const { return omega_error(s) + (several - 1.0) * drift_; }
  static constexpr double several = 8.0;
  double theta_slack() const {
    return exactness_.relative * way_ + (way_ > 0.0 ? exactness_.angle : 0.0) + theta_drift_;
  }

  /// What of the pull at rest and of the distance from the surface may be rounding, of torques, time, angle or speed.
  struct Slack {
    double pull, beyond;
  };
  Slack slack(int sigma, bool at_rest, Quad s, double rate) { return slack(sigma, at_rest, s, rate, course_.theta, 0); }
  Slack slack(int sigma, bool at_rest, Quad s, double rate, Quad theta, Quad omega) {
    const Quad t = course_.t;
    course_.t = t + s;
    Slack sum{rate * time_slack(0), rate * time_slack(0)};
    const double turned = theta_slack(), faster = at_rest ? 0.0 : omega_slack(s);
    for (int flank : at_rest ? std::vector{1, -1} : std::vector{mode_.flank}) {
      const auto here = course_.now(sigma, flank, at_rest, theta, omega);
      const auto there = course_.now(sigma, flank, at_rest, theta + Quad(turned), omega);
      const auto then = course_.now(sigma, flank, at_rest, theta, omega + Quad(faster));
      sum.pull += rounding * here.pull.size + std::abs(number(there.pull.value - here.pull.value));
      sum.beyond += rounding * here.beyond.size + std::abs(number(there.beyond.value - here.beyond.value)) +
                    std::abs(number(then.beyond.value - here.beyond.value));
    }
    course_.t = t;
    return sum;
  }

  Quad fail(const std::string& what, Quad s, double amount, double allowed) {
    excess_ = std::abs(amount) / allowed;
    complaint_ = at(what + ", allowed " + text(allowed), s);
    return 0;
  }
  std::string at(const std::string& what, Quad s = 0) const {
    return "at " + text(course_.t + s) + " s, motion " + std::to_string(mode_.motion) + ", flank " +
           std::to_string(mode_.flank) + ": " + what;
  }
  static std::string text(Quad x) {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.12g", number(x));
    return digits;
  }

  EventSequence<Quad> course_;
  Exactness exactness_;
  Mode mode_;
  std::string complaint_;
  double excess_ = std::numeric_limits<double>::infinity();
  double inputs_before_ = 0.0;
  Quad began_ = -1;                       ///< when the present motion did [s]
  std::vector<Quad> ages_;                ///< since when the gear may be at rest [s]
  double fastest_ = 0.0, hardest_ = 0.0;  ///< speed and acceleration of the present motion [rad/s, rad/s^2]
  double late_ = 0.0;                     ///< by how much roundings may delay the start of the present motion [s]
  double drift_ = 0.0;                    ///< of the speed, by roundings of the torques [rad/s]
  double way_ = 0.0, theta_drift_ = 0.0;  ///< of the angle so far, and its drift [rad]
};

}  // namespace judge
