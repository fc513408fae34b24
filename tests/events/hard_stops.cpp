#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "catch.hpp"
#include "events/four_modes.hpp"
#include "events/runge_kutta.hpp"
#include "events/torque_ratio.hpp"
#include "near_ties/dice.hpp"
#include "numbers.hpp"
#include "support.hpp"

// Stops that do not yield: bounces in closed form, momentum and energy of an impact through the mesh, a judge with
// fixed steps, and elastic stops that become ever stiffer.

namespace wormdrive::test::events_hard_stops {

namespace {

using Stops = HardStops<double>;
constexpr int impulse = 2 + int{StateLayout<EffectList<double>>::first<Stops>()};

template <class Instant>
bool hits(const Instant& before, const Instant& after) {
  return before.x[impulse] != after.x[impulse];
}

}  // namespace

TEST_CASE("an inertia that a torque holds against a stop bounces as its closed form says, and comes to rest there") {
  for (int trial = 0; trial < 20; ++trial) {
    near_ties::Dice dice(20261201, static_cast<std::uint64_t>(trial));
    const double J = dice.decades(1e-5, 1e2), way = dice.decades(1e-3, 10.0), first = dice.decades(1e-2, 1e3),
                 a = 2.0 * way / (first * first), e = trial == 0 ? 0.0 : dice.between(0.05, 0.8);
    const double side = dice.sign(), speed = a * first;
    Stops stops;
    (side > 0.0 ? stops.high : stops.low) = side * way;
    stops.restitution = e;
    const double rest = first + 2.0 * speed * e / (a * (1.0 - e)), end = 1.1 * rest;
    for (const By by : every_solver) {
      INFO(trial << " by " << static_cast<int>(by.solver) << static_cast<int>(by.method) << ", e " << e);
      const auto seen =
          run(drive_with_states(GearMesh<double>::without_teeth(J), Signal{}, constant(side * J * a), effects(stops)),
              Timetable(0, end, end), {}, tight(by));
      double due = first, v = speed, sum = 0.0;
      int impacts = 0;
      for (const auto& event : seen.events) {
        if (!hits(event.before, event.after)) continue;
        // what the angle errs by counts the more the smaller the bounces become
        if (v > 1e-5 * speed) CHECK(std::abs(event.after.t - due) <= 1e-11 * way / v + 1e-11 * rest);
        sum -= side * J * v * (1.0 + e);
        CHECK(std::abs(event.after.x[impulse] - sum) <= 1e-10 * J * speed * std::max(1.0, speed / v));
        v *= e;
        due += 2.0 * v / a;
        ++impacts;
      }
      CHECK(impacts >= (e == 0.0 ? 1 : 4));
      CHECK(seen.end.mode.motion == Motion::stuck);
      CHECK(std::abs(seen.end.x[0] - side * way) <= 1e-12 * way);
      CHECK(std::abs(seen.events.back().after.t - rest) <= 1e-5 * rest);
    }
  }
}

TEST_CASE("an impact through the mesh keeps momentum, and gives back the share of energy that it says") {
  int thrown = 0, wedged = 0;
  for (int trial = 0; trial < 40; ++trial) {
    near_ties::Dice dice(20261202, static_cast<std::uint64_t>(trial));
    MeshParameters<double> p = closing(table1(), std::floor(dice.decades(5.0, 80.0)), dice.between(0.03, 0.5));
    p.Jw = dice.decades(1e-6, 1e-2);
    p.mu = dice.between(0.0, 0.3);
    p.Jg = p.Jw * dice.decades(0.1, 100.0);
    const double C1 = torque_ratio(p, p.mu), C2 = torque_ratio(p, -p.mu);
    if (C1 < 0.0) p.Jg = std::min(p.Jg, -0.5 * p.Jw * p.i / C1);
    const double side = dice.sign(), speed = dice.decades(1e-3, 1e3);
    Stops stops;
    (side > 0.0 ? stops.high : stops.low) = side * dice.decades(1e-3, 1.0);
    stops.restitution = dice.between(0.1, 1.0);
    const double way = std::abs(side > 0.0 ? *stops.high : *stops.low);
    for (const By by : every_solver) {
      INFO(trial << " by " << static_cast<int>(by.solver) << static_cast<int>(by.method));
      typename decltype(drive_with_states(GearMesh<double>(p), Signal{}, Signal{}, effects(stops)))::Instant start;
      start.x[1] = side * speed;
      const auto seen = run(drive_with_states(GearMesh<double>(p), Signal{}, Signal{}, effects(stops)),
                            Timetable(0, 3.0 * way / speed, way / speed), start, tight(by));
      const auto hit =
          std::find_if(seen.events.begin(), seen.events.end(), [](const auto& e) { return hits(e.before, e.after); });
      REQUIRE(hit != seen.events.end());
      CHECK(std::abs(hit->after.t - way / speed) <= 1e-11 * way / speed);
      const double in = speed, out = -side * hit->after.x[1], P = -side * hit->after.x[impulse];
      const double M1 = p.Jw * p.i + C1 * p.Jg, M2 = p.Jw * p.i + C2 * p.Jg;
      // the way in with C2, the way out with C1; the stop has taken M2/C2 in^2/2 and gives M1/C1 out^2/2
      CHECK(close(P, M2 / C2 * in + (out > 0.0 ? M1 / C1 * out : 0.0), 1e-11));
      if (C1 > 0.0) {
        CHECK(close(M1 / C1 * out * out, stops.restitution * stops.restitution * M2 / C2 * in * in, 1e-11));
        ++thrown;
      } else {
        CHECK(hit->after.mode.motion == Motion::stuck);
        CHECK(out == 0.0);
        ++wedged;
      }
    }
  }
  CHECK(thrown > 20);
  CHECK(wedged > 20);
}

TEST_CASE("hard stops are what elastic stops come to as their stiffness grows, through a mesh with friction") {
  MeshParameters<double> p = closing(table1(0.03));
  p = closing(p, 20, 0.12);
  EndStops soft;
  soft.low = -0.2;
  soft.high = 0.3;
  Stops hard{soft.low, soft.high, 1.0};
  const Signal motor{{Sinusoid{.amplitude = 0.03, .frequency = 1.3, .phase = 0.4}}};
  const double end = 1.1;
  const auto rigid = run(drive_with_states(GearMesh<double>(p), constant(0.01), motor, effects(hard)),
                         Timetable(0, end, end), {}, tight(taylor));
  REQUIRE(std::count_if(rigid.events.begin(), rigid.events.end(),
                        [](const auto& e) { return hits(e.before, e.after); }) >= 3);
  double before = 0.0;
  for (const double k : {1e4, 1e6, 1e8}) {
    soft.stiffness = k;
    const auto elastic =
        run(drive(p, LoadSum{{Constant{0.01}, soft}}, motor), Timetable(0, end, end), {}, tight(bdf, 1e-12));
    const double off = std::abs(elastic.end.x[0] - rigid.end.x[0]);
    INFO("stiffness " << k << ", off by " << off);
    if (before > 0.0) CHECK(before / off == Catch::Approx(10.0).epsilon(0.2));  // with the root of the stiffness
    before = off;
  }
  CHECK(before < 1e-3);
}

namespace {

/// A worm drive between two stops under a motor torque level + amplitude cos(omega t + phase) and a constant load.
struct Case {
  MeshParameters<double> p;
  Stops stops;
  double level, amplitude, omega, phase, tau_l;
};

/// Its motion by Runge-Kutta steps of angle and speed, from mode to mode and from impact to impact.
class Judge {
 public:
  struct Event {
    double t;
    Mode after;
    bool impact;
  };

  Judge(const Case& c, double duration, double step) : c_(c) {
    mode_ = from_rest();
    follow(
        duration, step, t, now, [this](double h) { return moved(h); },
        [this](double when, const Eigen::Vector2d& x) { return holds(when, x); },
        [this] {
          const bool impact = beyond_stop(now);
          if (impact)
            hit();
          else if (mode_.motion == Motion::stuck || sign(mode_.motion) * now[1] <= 0.0)
            mode_ = rest();
          else
            mode_.flank = mode_.flank == Flank::left ? Flank::right : Flank::left;
          events.push_back({t, mode_, impact});
          return events.size() <= 200;
        });
  }

  std::vector<Event> events;
  double t = 0.0;
  Eigen::Vector2d now{0.0, 0.0};

 private:
  double tau_m(double when) const { return c_.level + c_.amplitude * std::cos(c_.omega * when + c_.phase); }
  double ratio(Mode in) const { return torque_ratio(c_.p, in.product() * c_.p.mu); }
  double inertia(Mode in) const { return c_.p.Jw * c_.p.i + ratio(in) * c_.p.Jg; }
  double acceleration(double when, Mode in) const { return (tau_m(when) + ratio(in) * c_.tau_l) / inertia(in); }
  double beyond(double when) const { return tau_m(when) - c_.p.Jw * c_.p.i / c_.p.Jg * c_.tau_l; }
  bool held(Motion way) const {
    return sign(way) * now[0] >= sign(way) * (way == Motion::forward ? *c_.stops.high : *c_.stops.low);
  }
  Mode from_rest() const {
    for (const Motion way : {Motion::forward, Motion::backward})
      if (const Mode in{way, flank_beyond(beyond(t))}; !held(way) && sign(way) * acceleration(t, in) > 0.0) return in;
    return {};
  }
  Mode rest() {
    now[1] = 0.0;
    return from_rest();
  }
  bool beyond_stop(const Eigen::Vector2d& x) const {
    return (mode_.motion == Motion::forward && x[0] >= *c_.stops.high) ||
           (mode_.motion == Motion::backward && x[0] <= *c_.stops.low);
  }
  void hit() {
    const Motion into = mode_.motion, back = into == Motion::forward ? Motion::backward : Motion::forward;
    const Flank flank = into == Motion::forward ? Flank::right : Flank::left;
    now[0] = into == Motion::forward ? *c_.stops.high : *c_.stops.low;
    const Mode in{into, flank}, out{back, flank};
    const double energy = inertia(in) / ratio(in) * now[1] * now[1];
    now[1] =
        ratio(out) <= 0.0 ? 0.0 : sign(back) * c_.stops.restitution * std::sqrt(energy * ratio(out) / inertia(out));
    mode_ = now[1] == 0.0 ? from_rest() : Mode{back, flank_beyond(beyond(t))};
  }
  bool holds(double when, const Eigen::Vector2d& x) const {
    if (beyond_stop(x)) return false;
    if (mode_.motion != Motion::stuck)
      return sign(mode_.motion) * x[1] >= 0.0 && -sign(mode_.flank) * beyond(when) >= 0.0;
    for (const Motion way : {Motion::forward, Motion::backward})
      if (!held(way) && sign(way) * acceleration(when, Mode{way, flank_beyond(beyond(when))}) > 0.0) return false;
    return true;
  }
  Eigen::Vector2d moved(double h) const {
    if (mode_.motion == Motion::stuck) return {now[0], 0.0};
    const auto rates = [this](double when, const Eigen::Vector2d& x) -> Eigen::Vector2d {
      return {x[1], acceleration(when, mode_)};
    };
    return runge_kutta(rates, t, now, h);
  }

  Case c_;
  Mode mode_;
};

}  // namespace

TEST_CASE("drives between two stops have the events and the end of a judge with fixed steps, by every solver") {
  int impacts = 0, drives = 0, to_the_end = 0;
  for (int trial = 0; trial < 24; ++trial) {
    near_ties::Dice dice(20261203, static_cast<std::uint64_t>(trial));
    Case c{};
    c.p = closing(table1(dice.between(0.02, 0.2)));
    c.tau_l = dice.sign() * dice.decades(0.003, 0.3);
    const double break_in = torque_ratio(c.p, -c.p.mu) * std::abs(c.tau_l);
    c.level = break_in * dice.between(-0.3, 0.3);
    c.amplitude = break_in * dice.decades(1.5, 6.0);
    c.omega = dice.decades(1.0, 100.0);
    c.phase = dice.between(-3.0, 3.0);
    const double swing = c.amplitude / (c.p.Jw * c.p.i + c.p.Jg / c.p.i) / (c.omega * c.omega);
    c.stops.low = -swing * dice.decades(0.03, 1.0);
    c.stops.high = swing * dice.decades(0.03, 1.0);
    c.stops.restitution = dice.chance(0.3) ? 0.0 : dice.between(0.2, 0.7);
    const double end = 2.0 * std::numbers::pi * dice.between(1.0, 2.0) / c.omega;
    const Judge judge(c, end, end / 4000.0);
    if (judge.events.empty()) continue;
    ++drives;
    for (const By by : every_solver) {
      INFO(trial << " by " << static_cast<int>(by.solver) << static_cast<int>(by.method));
      const Signal motor{{Constant{c.level}, Sinusoid{c.amplitude, c.omega / (2.0 * std::numbers::pi), c.phase}}};
      SolverSettings settings = tight(by);
      settings.absolute_tolerance = 1e-14 * std::min(1.0, swing);
      const auto seen = run(drive_with_states(GearMesh<double>(c.p), constant(c.tau_l), motor, effects(c.stops)),
                            Timetable(0, end, end / 10.0), {}, settings);
      std::vector<Judge::Event> found;
      for (const auto& e : seen.events) found.push_back({e.after.t, e.after.mode, hits(e.before, e.after)});
      // ever smaller bounces are followed as far as steps can
      std::size_t followed = 1;
      while (followed < judge.events.size() && judge.events[followed].t - judge.events[followed - 1].t > 1e-3 * end)
        ++followed;
      REQUIRE(found.size() >= followed);
      for (std::size_t k = 0; k < followed; ++k) {
        CHECK(std::abs(found[k].t - judge.events[k].t) <= 1e-7 * end);
        CHECK(found[k].impact == judge.events[k].impact);
        CHECK(found[k].after == judge.events[k].after);
        impacts += found[k].impact ? 1 : 0;
      }
      if (followed < judge.events.size()) continue;
      CHECK(found.size() == followed);
      CHECK(std::abs(seen.end.x[0] - judge.now[0]) <= 1e-6 * swing);
      ++to_the_end;
    }
  }
  CHECK(drives > 15);
  CHECK(to_the_end > 10);
  CHECK(impacts > 100);
}

TEST_CASE("at a stop the gear stays whatever pushes, the stop takes it, and it leaves at its break-in torque") {
  for (int trial = 0; trial < 12; ++trial) {
    near_ties::Dice dice(20261204, static_cast<std::uint64_t>(trial));
    MeshParameters<double> p = closing(table1(dice.between(0.02, 0.2)));
    const double load = dice.decades(1e-2, 10.0), turn = dice.decades(1e-2, 1e4), push = load * dice.decades(0.05, 5.0);
    // the load pulls back; the motor pushes into the stop and then pulls, slowly
    const double C1 = torque_ratio(p, p.mu), leaves = C1 * load;  // backward on the right flank
    Stops stops;
    stops.high = 0.0;
    const Signal motor{{Constant{push}, Ramp{.rate = -2.0 * (push + std::abs(leaves)) / turn}}};
    const double due = (push - leaves) / (2.0 * (push + std::abs(leaves)) / turn);
    for (const By by : every_solver) {
      INFO(trial << " by " << static_cast<int>(by.solver) << static_cast<int>(by.method));
      const auto seen = run(drive_with_states(GearMesh<double>(p), constant(-load), motor, effects(stops)),
                            Timetable(0, 1.05 * due, 1.05 * due / 20), {}, tight(by));
      REQUIRE_FALSE(seen.events.empty());
      CHECK(std::abs(seen.events.front().after.t - due) <= 1e-11 * due);
      CHECK(seen.events.front().after.mode.motion == Motion::backward);
      for (const auto& row : seen.rows) {
        if (row.now.t >= due) break;
        const double C2 = torque_ratio(p, -p.mu), total = std::max(load, row.seen.tau_m / C2);
        CHECK(close(row.seen.tau_l, -total, 1e-12));
        CHECK(row.now.x[0] == 0.0);
      }
    }
  }
}

TEST_CASE("a stop pushes and never pulls, and takes no more than friction leaves") {
  int taken = 0, held = 0;
  for (int trial = 0; trial < 400; ++trial) {
    near_ties::Dice dice(20261205, static_cast<std::uint64_t>(trial));
    MeshParameters<double> p = closing(table1(), std::floor(dice.decades(5.0, 80.0)), dice.between(0.03, 0.5));
    p.mu = trial % 10 == 0 ? GearMesh<double>(p).mu_w() : dice.between(0.0, 0.3);  // C1 is rounding
    p.Jg = p.Jw * 0.1;
    const double load = dice.sign() * dice.decades(1e-3, 1e3),
                 push = dice.sign() * std::abs(load) * dice.decades(1e-3, 1.0), side = dice.sign();
    Stops stops;
    (side > 0.0 ? stops.high : stops.low) = 0.0;
    const auto d = drive_with_states(GearMesh<double>(p), constant(load), constant(push), effects(stops));
    const auto seen = run(d, Timetable(0, 1e-6, 1e-6), {}, tight(taylor));
    if (!seen.events.empty() || seen.end.mode.motion != Motion::stuck) continue;
    const double shown = seen.rows.back().seen.tau_l, stop = side * (shown - load), C1 = torque_ratio(p, p.mu),
                 C2 = torque_ratio(p, -p.mu);
    INFO(trial << ", side " << side << ", motor " << push << ", load " << load << ", shown " << shown);
    CHECK(std::isfinite(seen.rows.back().seen.normal_force));
    CHECK(stop <= 0.0);
    const bool by_worm = side * push > 0.0;
    if (stop < 0.0) {
      CHECK(close(shown, -push / (by_worm ? C2 : C1), 1e-9));
      ++taken;
    } else {
      CHECK((by_worm ? side * (push + C2 * load) <= 0.0 : C1 < 1e-14 || side * (push + C1 * load) <= 0.0));
      ++held;
    }
  }
  CHECK(taken > 50);
  CHECK(held > 50);
}

TEST_CASE("a gear that bounces ever less rests at its stop and not beyond it, at every tolerance and restitution") {
  Stops stops;
  stops.high = 1.0;
  for (const By by : every_solver)
    for (const double tolerance : {1e-3, 1e-6, 1e-10})
      for (const double e : {0.0, 0.3, 0.9, 0.985}) {
        INFO(static_cast<int>(by.solver) << static_cast<int>(by.method) << ", " << tolerance << ", e " << e);
        stops.restitution = e;
        SolverSettings settings = tight(by, tolerance);
        const auto d = drive_with_states(GearMesh<double>::without_teeth(1.0), Signal{}, constant(1.0), effects(stops));
        const double rest = std::sqrt(2.0) * (1.0 + 2.0 * e / (1.0 - e));
        const auto seen = run(d, Timetable(0, 2.0 * rest, rest), {}, settings);
        CHECK(seen.end.x[0] == 1.0);
        CHECK(seen.end.mode.motion == Motion::stuck);
        CHECK(seen.events.size() < 3000);
      }
}

}  // namespace wormdrive::test::events_hard_stops
