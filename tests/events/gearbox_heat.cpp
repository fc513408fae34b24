#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "catch.hpp"
#include "core/states/starting_state.hpp"
#include "events/four_modes.hpp"
#include "events/runge_kutta.hpp"
#include "events/torque_ratio.hpp"
#include "near_ties/dice.hpp"
#include "numbers.hpp"
#include "support.hpp"

// A gearbox that its own friction warms: against closed forms, the balance of energy, and a judge of its own with fixed
// steps.

namespace wormdrive::test::events_gearbox_heat {

namespace {

using Heat = GearboxHeat<double>;
constexpr int warmth = 2 + int{StateLayout<EffectList<double>>::first<Heat>()};

auto heated(const MeshParameters<double>& p, const Signal& load, const Signal& motor, const Effects<double>& on) {
  return drive_with_states(GearMesh<double>(p), load, motor, on);
}
/// A run from a start at rest, or at a speed.
template <class Drive>
auto run_from(const Drive& d, double omega, const Timetable& timetable, const SolverSettings& settings) {
  typename Drive::Instant start;
  start.x = starting_state(d, {.omega_g = omega}, 0.0);
  return run(d, timetable, start, settings);
}
/// The same with so little inertia of the gear that eq. 17 holds.
MeshParameters<double> without_jam(MeshParameters<double> p) {
  if (const double C1 = torque_ratio(p, p.mu); C1 < 0.0) p.Jg = std::min(p.Jg, -0.5 * p.Jw * p.i / C1);
  return p;
}
/// A gear that closes, from a back-drivable to a self-locking one.
MeshParameters<double> drawn_mesh(near_ties::Dice& dice, double least_friction) {
  MeshParameters<double> p = closing(table1(), std::floor(dice.decades(5.0, 80.0)), dice.between(0.03, 0.3));
  p.Jw = dice.decades(1e-6, 1e-2);
  p.Jg = p.Jw * dice.decades(1.0, 100.0);
  p.mu = dice.between(least_friction, 0.2);
  return without_jam(p);
}
double unit_of(const MeshParameters<double>& p) { return p.Jw * p.i + p.Jg / p.i; }  // N m for 1 rad/s^2 of the gear

}  // namespace

TEST_CASE("a gearbox that a constant torque drives warms as its closed form says, over decades of time and size") {
  for (int trial = 0; trial < 20; ++trial) {
    near_ties::Dice dice(20261127, static_cast<std::uint64_t>(trial));
    const MeshParameters<double> p = drawn_mesh(dice, 0.03);
    const double end = dice.decades(1e-2, 1e3), tau_m = unit_of(p) * dice.decades(1e-1, 1e2) / (end * end);
    const double a = tau_m / (p.Jw * p.i + torque_ratio(p, -p.mu) * p.Jg);  // forward, right flank
    // friction takes what the motor gives and the inertias do not: in proportion to time
    const double rate = (tau_m * p.i - (p.Jw * p.i * p.i + p.Jg) * a) * a;
    Heat heat;
    heat.heat_capacity = rate * end * end * dice.decades(1e-2, 1.0);
    const double tau = end * dice.decades(1e-1, 10.0), R = tau / *heat.heat_capacity;
    heat.thermal_resistance = R;
    heat.starting_rise = dice.between(0.0, 50.0);
    for (const By by : every_solver) {
      const auto seen =
          run_from(heated(p, Signal{}, constant(tau_m), effects(heat)), 0.0, Timetable(0, end, end / 20), tight(by));
      INFO(trial << " by " << static_cast<int>(by.solver) << static_cast<int>(by.method) << ", end " << end);
      Deviation off;
      for (const auto& row : seen.rows) {
        const double t = row.now.t, left = std::exp(-t / tau);
        const double h = rate * R * (t - tau * (1.0 - left)) + heat.starting_rise * left;
        off.add((row.now.x[warmth] - h) / (1.0 + h));
      }
      CHECK(off <= 1e-9);
    }
  }
}

TEST_CASE("what motor and load give a drive is in its speed and in the heat of its gearbox") {
  int events = 0;
  for (int trial = 0; trial < 20; ++trial) {
    near_ties::Dice dice(20261128, static_cast<std::uint64_t>(trial));
    const MeshParameters<double> p = drawn_mesh(dice, 0.03);
    const double end = dice.decades(1e-1, 1e4), size = unit_of(p) * dice.decades(1.0, 100.0) / (end * end);
    const double tau_l = dice.sign() * size * dice.between(0.0, 2.0), step = size * dice.between(2.0, 6.0);
    const double turned = end * dice.between(0.2, 0.8);  // the motor changes its side here
    const Signal motor{{Constant{step}, Step{-1.5 * step, turned}}};
    Heat heat;
    heat.friction_decay = dice.decades(1e-3, 1e-1);
    heat.churning = size / (p.i * 10.0) * end * dice.decades(1e-2, 1.0);
    heat.churning_decay = dice.decades(1e-3, 1e-1);
    heat.heat_capacity = size * dice.decades(0.1, 10.0);
    heat.starting_rise = dice.between(0.0, 20.0);
    const auto on = effects(heat, WormCoulomb<double>{0.1 * size}, GearViscous<double>{0.05 * size * end});
    for (const By by : every_solver) {
      INFO(trial << " by " << static_cast<int>(by.solver) << static_cast<int>(by.method));
      const auto d = heated(p, constant(tau_l), motor, on);
      const auto seen = run_from(d, 0.0, Timetable(0, end, turned / 2.0), tight(by));
      // the motor's work, torque by torque
      double at_turn = 0.0;
      for (const auto& row : seen.rows)
        if (row.now.t <= turned) at_turn = row.now.x[0];
      const double work = p.i * (step * at_turn - 0.5 * step * (seen.end.x[0] - at_turn)) + tau_l * seen.end.x[0];
      const double kinetic = 0.5 * (p.Jw * p.i * p.i + p.Jg) * seen.end.x[1] * seen.end.x[1];
      const double heated = *heat.heat_capacity * (seen.end.x[warmth] - heat.starting_rise);
      CHECK(std::abs(work - kinetic - heated) <= 2e-9 * (std::abs(work) + kinetic + heated));
      CHECK(heated >= 0.0);
      events += static_cast<int>(seen.events.size());
    }
  }
  REQUIRE(events > 60);
}

namespace {

/// A worm drive whose friction falls as it warms up, under a motor torque level + amplitude cos(omega t + phase).
struct Case {
  MeshParameters<double> p;
  Heat heat;
  double level, amplitude, omega, phase, tau_l;
};

/// Its motion by Runge-Kutta steps of angle, speed and temperature, from mode to mode.
class Judge {
 public:
  struct Event {
    double t;
    Mode after;
  };

  Judge(const Case& c, double duration, double step) : c_(c), now(0.0, 0.0, c.heat.starting_rise) {
    mode_ = mode_from_rest(beyond(t, now), accelerations(t, now));
    follow(
        duration, step, t, now, [this](double h) { return moved(h); },
        [this](double when, const Eigen::Vector3d& x) { return holds(when, x); },
        [this] {
          mode_ = mode_behind(mode_, now[1], beyond(t, now), accelerations(t, now));
          events.push_back({t, mode_});
          return events.size() <= 100;
        });
  }

  std::vector<Event> events;

 private:
  std::function<double(Mode)> accelerations(double when, const Eigen::Vector3d& x) const {
    return [this, when, x](Mode in) { return acceleration(when, x, in); };
  }
  double mu(double h) const { return c_.p.mu * std::exp(-c_.heat.friction_decay * h); }
  double tau_w(double when, const Eigen::Vector3d& x) const {
    return c_.level + c_.amplitude * std::cos(c_.omega * when + c_.phase) -
           c_.heat.churning * std::exp(-c_.heat.churning_decay * x[2]) * c_.p.i * x[1];
  }
  double beyond(double when, const Eigen::Vector3d& x) const {
    return tau_w(when, x) - c_.p.Jw * c_.p.i / c_.p.Jg * c_.tau_l;
  }
  double acceleration(double when, const Eigen::Vector3d& x, Mode in) const {
    const double C = torque_ratio(c_.p, in.product() * mu(x[2]));
    return (tau_w(when, x) + C * c_.tau_l) / (c_.p.Jw * c_.p.i + C * c_.p.Jg);
  }
  bool holds(double when, const Eigen::Vector3d& x) const {
    return mode_holds(mode_, x[1], beyond(when, x), accelerations(when, x));
  }
  /// What is lost: all power that goes in and moves no inertia.
  double loss(double when, const Eigen::Vector3d& x) const {
    const double motor = c_.level + c_.amplitude * std::cos(c_.omega * when + c_.phase);
    return (motor * c_.p.i + c_.tau_l - (c_.p.Jw * c_.p.i * c_.p.i + c_.p.Jg) * acceleration(when, x, mode_)) * x[1];
  }
  Eigen::Vector3d moved(double h) const {
    const auto rates = [this](double when, const Eigen::Vector3d& x) -> Eigen::Vector3d {
      const double leaves = x[2] / *c_.heat.thermal_resistance, C = *c_.heat.heat_capacity;
      if (mode_.motion == Motion::stuck) return {0.0, 0.0, -leaves / C};
      return {x[1], acceleration(when, x, mode_), (loss(when, x) - leaves) / C};
    };
    return runge_kutta(rates, t, now, h);
  }

  Case c_;
  Mode mode_;

 public:
  double t = 0.0;
  Eigen::Vector3d now;
};

}  // namespace

TEST_CASE("drives whose friction falls as they warm up have the events and the end of a judge with fixed steps") {
  int events = 0, stops = 0;
  for (int trial = 0; trial < 16; ++trial) {
    near_ties::Dice dice(20261129, static_cast<std::uint64_t>(trial));
    Case c{};
    c.p = closing(table1(dice.between(0.05, 0.25)));
    c.tau_l = dice.sign() * dice.decades(0.003, 0.3);
    const double break_in = std::abs(torque_ratio(c.p, -c.p.mu) * c.tau_l);
    c.level = break_in * dice.between(-0.5, 0.5);
    c.amplitude = break_in * dice.decades(1.2, 5.0);
    c.omega = dice.decades(3.0, 300.0);
    c.phase = dice.between(-3.0, 3.0);
    const double end = 2.0 * std::numbers::pi * dice.between(1.5, 3.0) / c.omega;
    const double power = c.amplitude * c.amplitude / (c.p.Jw * c.omega);
    c.heat.friction_decay = dice.decades(0.003, 0.03);
    c.heat.churning = 0.2 * c.p.Jw * c.omega;
    c.heat.churning_decay = dice.decades(0.003, 0.03);
    c.heat.heat_capacity = power * end / dice.decades(10.0, 100.0);
    c.heat.thermal_resistance = end * dice.decades(0.3, 3.0) / *c.heat.heat_capacity;
    c.heat.starting_rise = dice.between(0.0, 20.0);
    const Judge rough(c, end, end / 4000.0), judge(c, end, end / 8000.0);
    if (rough.events.size() != judge.events.size()) continue;
    const double fast = std::max(std::abs(judge.now[1]), 1e-3);
    for (const By by : every_solver) {
      INFO(trial << " by " << static_cast<int>(by.solver) << static_cast<int>(by.method));
      const Signal motor{{Constant{c.level}, Sinusoid{c.amplitude, c.omega / (2.0 * std::numbers::pi), c.phase}}};
      const auto seen = run_from(heated(c.p, constant(c.tau_l), motor, effects(c.heat)), 0.0,
                                 Timetable(0, end, end / 10.0), tight(by));
      REQUIRE(seen.events.size() == judge.events.size());
      for (std::size_t k = 0; k < judge.events.size(); ++k) {
        CHECK(seen.events[k].after.mode == judge.events[k].after);
        CHECK(std::abs(seen.events[k].after.t - judge.events[k].t) <= 1e-7 * end);
        stops += judge.events[k].after.motion == Motion::stuck ? 1 : 0;
      }
      CHECK(std::abs(seen.end.x[1] - judge.now[1]) <=
            std::max(0.2 * std::abs(rough.now[1] - judge.now[1]), 1e-8 * fast));
      CHECK(std::abs(seen.end.x[warmth] - judge.now[2]) <=
            std::max(0.2 * std::abs(rough.now[2] - judge.now[2]), 1e-8 * (1.0 + judge.now[2])));
    }
    events += static_cast<int>(judge.events.size());
  }
  CHECK(events > 80);
  CHECK(stops > 10);
}

TEST_CASE("a gearbox that cools while it holds breaks away where torque and friction meet") {
  for (int trial = 0; trial < 20; ++trial) {
    near_ties::Dice dice(20261130, static_cast<std::uint64_t>(trial));
    MeshParameters<double> p = drawn_mesh(dice, 0.1);
    p = without_jam(closing(p, p.i, dice.between(0.01, 0.04)));  // it locks itself, however warm
    const double load = dice.decades(1e-3, 1e3), tau = dice.decades(1e-2, 1e5);
    Heat heat;
    heat.friction_decay = dice.decades(1e-3, 1e-2);
    heat.heat_capacity = dice.decades(1.0, 1e3);
    heat.thermal_resistance = tau / *heat.heat_capacity;
    heat.starting_rise = dice.between(10.0, 80.0);
    // forward against a load, on the right flank: the torque is C(-mu) times the load, more as it cools
    const auto needed = [&](double t) {
      const double h = heat.starting_rise * std::exp(-t / tau);
      return load * torque_ratio(p, -p.mu * std::exp(-heat.friction_decay * h));
    };
    const double rate = needed(0.0) / tau * dice.decades(0.5, 5.0);
    const double due = end_of(0.0, 20.0 * tau, [&](double t) { return rate * t < needed(t); });
    for (const By by : every_solver) {
      INFO(trial << " by " << static_cast<int>(by.solver) << static_cast<int>(by.method));
      const auto seen = run_from(heated(p, constant(-load), Signal{{Ramp{.rate = rate}}}, effects(heat)), 0.0,
                                 Timetable(0, 1.01 * due, due), tight(by));
      const auto moves = std::find_if(seen.events.begin(), seen.events.end(),
                                      [](const auto& e) { return e.after.mode.motion != Motion::stuck; });
      REQUIRE(moves != seen.events.end());
      CHECK(moves->after.mode.motion == Motion::forward);
      CHECK(std::abs(moves->after.t - due) <= 1e-10 * due);
    }
  }
}

}  // namespace wormdrive::test::events_gearbox_heat
