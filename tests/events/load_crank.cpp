#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "core/energy.hpp"
#include "core/states/starting_state.hpp"
#include "core/steady.hpp"
#include "events/flywheel.hpp"
#include "events/four_modes.hpp"
#include "events/runge_kutta.hpp"
#include "events/slider_crank.hpp"
#include "events/torque_ratio.hpp"
#include "near_ties/dice.hpp"
#include "numbers.hpp"
#include "support.hpp"

// A crank that pushes a mass to and fro, against energy, and against a judge of its own: fixed steps,
// and the way of the mass from its geometry alone.

namespace wormdrive::test::events_load_crank {

namespace {

using Crank = LoadCrank<double>;

Crank drawn_crank(near_ties::Dice& dice, double beside) {
  Crank c;
  c.crank = dice.decades(1e-3, 1.0);
  if (dice.chance(0.7)) c.rod = c.crank * dice.decades(1.02, 10.0);
  c.mass = beside * dice.decades(0.1, 10.0) / (c.crank * c.crank);
  c.shift = dice.between(-3.0, 3.0);
  return c;
}

/// A worm drive with a crank under a torque level + amplitude cos(omega t + phase) and a constant load.
struct Case {
  MeshParameters<double> p;
  Crank crank;
  double level, amplitude, omega, phase, tau_l;
};

/// Its motion by Runge-Kutta steps of angle and speed, from mode to mode.
class Judge {
 public:
  struct Event {
    double t;
    Mode after;
  };
  struct Place {
    double t = 0.0, theta = 0.0, omega = 0.0;
  };

 private:
  auto accelerations(const Place& x) const {
    return [this, &x](Mode in) { return acceleration(x, in); };
  }

 public:
  Judge(const Case& c, double duration, double step) : c_(c) {
    mode_ = mode_from_rest(beyond(now), accelerations(now));
    double t = 0.0;
    follow(
        duration, step, t, now, [this](double h) { return moved(h); },
        [this](double, const Place& x) { return holds(x); },
        [this] {
          mode_ = mode_behind(mode_, now.omega, beyond(now), accelerations(now));
          events.push_back({now.t, mode_});
          return events.size() <= 100;
        });
  }

  Place now;
  std::vector<Event> events;

 private:
  double tau_m(double t) const { return c_.level + c_.amplitude * std::cos(c_.omega * t + c_.phase); }
  /// Inertia of the gear side.
  double J(double theta) const { return c_.p.Jg + inertia(c_.crank, theta); }
  double tau_g(const Place& x) const { return c_.tau_l - half_slope(c_.crank, x.theta) * x.omega * x.omega; }
  double beyond(const Place& x) const { return tau_m(x.t) - c_.p.Jw * c_.p.i / J(x.theta) * tau_g(x); }
  double acceleration(const Place& x, Mode in) const {
    const double C = torque_ratio(c_.p, in.product() * c_.p.mu);
    return (tau_m(x.t) + C * tau_g(x)) / (c_.p.Jw * c_.p.i + C * J(x.theta));
  }
  bool holds(const Place& x) const { return mode_holds(mode_, x.omega, beyond(x), accelerations(x)); }
  Place moved(double h) const {
    if (mode_.motion == Motion::stuck) return {now.t + h, now.theta, 0.0};
    const auto rates = [this](double t, const Eigen::Vector2d& x) -> Eigen::Vector2d {
      return {x[1], acceleration({t, x[0], x[1]}, mode_)};
    };
    const Eigen::Vector2d x = runge_kutta(rates, now.t, Eigen::Vector2d(now.theta, now.omega), h);
    return {now.t + h, x[0], x[1]};
  }

  Case c_;
  Mode mode_;
};

}  // namespace

TEST_CASE("a flywheel that drives a mass by a crank turns as its energy says, with a rod or a slot") {
  check_energy_of_flywheels(20261203, drawn_crank, [](const Crank& c, double theta_g) { return inertia(c, theta_g); });
}

TEST_CASE("worm drives with a crank have the events and the end of a judge with fixed steps, by every solver") {
  int events = 0;
  for (int trial = 0; trial < 25; ++trial) {
    near_ties::Dice dice(20261204, static_cast<std::uint64_t>(trial));
    Case c{};
    c.p = table1(dice.between(0.05, 0.2));
    c.crank = drawn_crank(dice, c.p.Jg);
    if (c.crank.rod) c.crank.rod = std::max(*c.crank.rod, 1.5 * c.crank.crank);
    c.tau_l = dice.sign() * dice.decades(0.003, 0.3);
    const double break_in = torque_ratio(c.p, -c.p.mu) * std::abs(c.tau_l);
    c.level = break_in * dice.between(-0.5, 0.5);
    c.amplitude = break_in * dice.decades(1.5, 10.0);
    c.omega = dice.decades(3.0, 30.0);
    c.phase = dice.between(-3.0, 3.0);
    const double end = 2.0 * std::numbers::pi * dice.between(1.0, 2.0) / c.omega;
    const GearMesh<double> mesh(c.p);
    // eq. 17 at every angle
    double most = 0.0;
    for (double angle = 0.0; angle < 3.2; angle += 0.01) most = std::max(most, inertia(c.crank, angle));
    if (mesh.C1() <= -0.9 * c.p.Jw * c.p.i / (c.p.Jg + most)) continue;
    const Judge rough(c, end, end / 4000.0), judge(c, end, end / 8000.0);
    if (rough.events.size() != judge.events.size()) continue;
    const double off = std::abs(rough.now.omega - judge.now.omega);  // of the rough one
    const double fast = std::max(std::abs(judge.now.omega), 1e-3);
    for (const By by : every_solver) {
      INFO(trial << " by " << static_cast<int>(by.solver) << static_cast<int>(by.method));
      const Signal motor{{Constant{c.level}, Sinusoid{c.amplitude, c.omega / (2.0 * std::numbers::pi), c.phase}}};
      const auto seen =
          run(drive(c.p, constant(c.tau_l), motor, effects(c.crank)), Timetable(0, end, end / 10.0), {}, tight(by));
      REQUIRE(seen.events.size() == judge.events.size());
      for (std::size_t k = 0; k < judge.events.size(); ++k) {
        CHECK(seen.events[k].after.mode == judge.events[k].after);
        CHECK(std::abs(seen.events[k].after.t - judge.events[k].t) <= 1e-7 * end);
      }
      CHECK(std::abs(seen.end.x[1] - judge.now.omega) <= std::max(0.2 * off, 1e-8 * fast));
    }
    events += static_cast<int>(judge.events.size());
  }
  REQUIRE(events > 60);
}

TEST_CASE("the motor of a crank at constant speed pays for the mass, to and fro") {
  const Crank crank{0.4, 0.05, 0.12, 0.3};
  const double omega = 7.0, theta = 0.9;
  const auto d = entered(table1(0.1), constant(0.0), constant(0.0), effects(crank));
  const double tau_g = -half_slope(crank, theta) * omega * omega;
  const double C = torque_ratio(table1(0.1), tau_g >= 0.0 ? 0.1 : -0.1);
  REQUIRE(close(steady_torque(d, 60.0 * omega, theta, 0.0), -C * tau_g, 1e-6));
  // behind a coupling, whose twist it does not look at, as well
  const auto behind =
      entered(table1(0.1), constant(0.0), constant(0.0), effects(crank, LoadCoupling<double>{1e-3, 50.0}));
  REQUIRE(close(steady_torque(behind, 60.0 * omega, theta, 0.0), -C * tau_g, 1e-6));
}

TEST_CASE("a crank behind a coupling that twists keeps the energy of both") {
  const Crank crank{0.4, 0.05, 0.12, 0.3};
  const double J1 = 2e-3, J2 = 1e-3, k = 0.5;
  constexpr int twist = 2 + int{StateLayout<EffectList<double>>::first<LoadCoupling<double>>()};
  const auto d = drive_with_states(GearMesh<double>::without_teeth(J1), Signal{}, Signal{},
                                   effects(crank, LoadCoupling<double>{J2, k}));
  REQUIRE(d.Jg() == J1);
  for (const By by : every_solver) {
    typename decltype(d)::Instant start;
    start.x = starting_state(d, {.omega_g = 20.0}, 0.0);
    const auto energy = [&](const auto& x) {
      return J1 * x[1] * x[1] + (J2 + inertia(crank, x[0] + x[twist])) * x[twist + 1] * x[twist + 1] +
             k * x[twist] * x[twist];
    };
    const auto seen = run(d, Timetable(0, 1, 0.05), start, tight(by));
    for (const auto& row : seen.rows) REQUIRE(close(energy(row.now.x), energy(start.x), 2e-9));
  }
}

}  // namespace wormdrive::test::events_load_crank
