#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "catch.hpp"
#include "core/statics.hpp"
#include "near_ties/dice.hpp"
#include "numbers.hpp"
#include "support.hpp"

// Bristles in the worm's bearings: Dahl's closed form along any way, the speed under a torque, a program of fixed steps
// for what breaks away, and the friction of Coulomb as the limit of bristles that do not bend.

namespace wormdrive::test::events_worm_lugre {

namespace {

WormLuGre<double> bristles(double torque, std::optional<double> stiffness, std::optional<double> damping = {}) {
  WormLuGre<double> friction;
  friction.coulomb_torque = torque;
  friction.stiffness = stiffness;
  friction.damping = damping;
  return friction;
}

template <class State>
double deflection(const State& x) {
  return x[2 + StateLayout<EffectList<double>>::first<WormLuGre<double>>()];
}

}  // namespace

TEST_CASE("bristles follow the solution of Dahl along every way, to and fro, at every stiffness") {
  near_ties::Dice dice(23, 0);
  for (int drawn = 0; drawn < 12; ++drawn) {
    const double J = dice.decades(1e-6, 1.0), torque = dice.decades(1e-3, 10.0), slides = dice.decades(1e-3, 1.0);
    const double speed = std::sqrt(torque * slides / J), swing = speed / slides;  // of J on its bristles [rad/s]
    Sinusoid push;
    push.amplitude = torque * dice.between(0.5, 3.0);
    push.frequency = swing * dice.decades(0.02, 0.5) / (2.0 * std::numbers::pi);
    const double end = 3.0 / push.frequency;
    for (const By by : every_solver) {
      const auto machine = drive_with_states(GearMesh<double>::without_teeth(J), Signal{}, Signal{{push}},
                                             effects(bristles(torque, torque / slides)));
      SolverSettings settings = tight(by, by.solver == SolverKind::taylor ? 1e-12 : 1e-11);
      settings.absolute_tolerance = 1e-13 * std::min(1.0, slides);
      const auto seen = run(machine, Timetable(0, end, end / 200), {}, settings);
      INFO("J " << J << ", torque " << torque << ", slides at " << slides << " rad, " << seen.events.size()
                << " events");
      REQUIRE(seen.events.size() >= 4);
      double from = 0.0, bent = 0.0;
      Mode mode{};
      const auto dahl = [&](double angle) {  // h on the way that began at from, bent so far
        const int way = sign(mode.motion);
        return way - (way - bent) * std::exp(-std::abs(angle - from) / slides);
      };
      for (const auto& row : seen.rows) {
        if (row.now.mode != mode) {
          bent = dahl(row.now.x[0]);
          from = row.now.x[0];
          mode = row.now.mode;
        }
        REQUIRE(std::abs(deflection(row.now.x) - dahl(row.now.x[0])) <= 1e-8);
      }
    }
  }
}

TEST_CASE("a worm on bristles turns as fast as sliding friction lets it, faster or slower than its Stribeck speed") {
  const double J = 3e-4, viscous = 2e-3, stribeck = 4.0, fast = 0.02, slow = 0.03;
  for (const double push : {0.0302, 0.035, 0.06})
    for (const By by : every_solver) {
      WormLuGre<double> friction = bristles(fast, 1.0, 0.01);
      friction.static_torque = slow;
      friction.stribeck_speed = stribeck;
      const auto machine = drive_with_states(GearMesh<double>::without_teeth(J), Signal{}, constant(push),
                                             effects(friction, WormViscous<double>{viscous}));
      const auto seen = run(machine, Timetable(0, 8, 1), {}, tight(by, 1e-11));
      const auto excess = [&](double w) {
        return push - viscous * w - fast - (slow - fast) * std::exp(-w * w / (stribeck * stribeck));
      };
      double low = 0.0, high = push / viscous;  // the first speed at which nothing is left
      for (double w = 0.0; w < high; w += 1e-3)
        if (excess(w) <= 0.0) {
          high = w;
          low = w - 1e-3;
          break;
        }
      const double steady = end_of(low, high, [&](double w) { return excess(w) > 0.0; });
      INFO("push " << push << ", " << seen.end.x[1] << " rad/s");
      REQUIRE(std::abs(seen.end.x[1] - steady) <= 1e-7 * steady);
    }
}

TEST_CASE("what a ramp breaks away at falls with its rate, as a program of fixed steps has it") {
  const double J = 2e-3, k = 40.0, d = 0.1, fast = 1.0, slow = 1.5, stribeck = 2.0, viscous = 0.05;
  double before = 1e9;
  for (const double rate : {0.5, 2.0, 8.0, 32.0}) {
    const double end = 2.4 / rate;
    // theta' = w, J w' = rate t - (k z + d z') - viscous w, z' = w - k w z/g(w), w >= 0: Runge-Kutta, step halved
    struct State {
      double theta, w, z;
    };
    const auto friction = [&](const State& x) {
      const double g = fast + (slow - fast) * std::exp(-x.w * x.w / (stribeck * stribeck));
      const double bend = x.w - k * x.w * x.z / g;
      return std::pair(k * x.z + d * bend, bend);
    };
    const auto by_fixed_steps = [&](long steps, double& peak) {
      State x{0, 0, 0};
      const double h = end / static_cast<double>(steps);
      peak = 0.0;
      const auto f = [&](double t, const State& s) {
        const auto [force, bend] = friction(s);
        return State{s.w, (rate * t - force - viscous * s.w) / J, bend};
      };
      const auto plus = [](const State& s, double by, const State& r) {
        return State{s.theta + by * r.theta, s.w + by * r.w, s.z + by * r.z};
      };
      for (long n = 0; n < steps; ++n) {
        const double t = static_cast<double>(n) * h;
        const State a = f(t, x), b = f(t + h / 2, plus(x, h / 2, a)), c = f(t + h / 2, plus(x, h / 2, b)),
                    e = f(t + h, plus(x, h, c));
        x = plus(plus(plus(plus(x, h / 6, a), h / 3, b), h / 3, c), h / 6, e);
        peak = std::max(peak, k * x.z);
      }
      return x;
    };
    double peak = 0.0;
    const State finest = by_fixed_steps(400'000, peak), coarser = by_fixed_steps(200'000, peak);
    REQUIRE(std::abs(finest.theta - coarser.theta) <= 1e-10);
    for (const By by : every_solver) {
      WormLuGre<double> bristle = bristles(fast, k, d);
      bristle.static_torque = slow;
      bristle.stribeck_speed = stribeck;
      const auto machine = drive_with_states(GearMesh<double>::without_teeth(J), Signal{}, Signal{{Ramp{.rate = rate}}},
                                             effects(bristle, WormViscous<double>{viscous}));
      const auto seen = run(machine, Timetable(0, end, end), {}, tight(by, 1e-12));
      INFO("rate " << rate);
      REQUIRE(std::abs(seen.end.x[0] - finest.theta) <= 1e-8);
      REQUIRE(std::abs(seen.end.x[1] - finest.w) <= 1e-8 * (1.0 + finest.w));
      REQUIRE(std::abs(deflection(seen.end.x) - k / fast * finest.z) <= 1e-8);
    }
    REQUIRE(peak < before);
    before = peak;
  }
}

TEST_CASE("the paper's drive on stiff bristles becomes the one with dry bearings, with order 2/3 in their stiffness") {
  // a rising torque starts it: the way grows with the cube of the time, and the bristles are part of it
  const double torque = 0.004;
  const Timetable times(0, 0.3, 0.3);
  const auto dry =
      run(drive(table1(), fig9_load(), fig9_motor(), effects(WormCoulomb<double>{torque})), times, {}, tight(taylor));
  const auto off = [&](const auto& seen) { return std::abs(seen.end.x[0] - dry.end.x[0]); };
  REQUIRE(dry.end.x[0] < -0.05);
  REQUIRE(off(run(drive(table1(), fig9_load(), fig9_motor(), effects(bristles(torque, {}))), times, {},
                  tight(taylor))) <= 1e-12);  // without stiffness it is that friction
  double before = 0.0;
  for (const double stiffness : {1e3, 1e4, 1e5}) {
    const double now = off(run(
        drive_with_states(GearMesh<double>(table1()), fig9_load(), fig9_motor(), effects(bristles(torque, stiffness))),
        times, {}, tight(bdf, 1e-12)));
    INFO("stiffness " << stiffness << ", off by " << now);
    if (before > 0.0) REQUIRE(std::abs(std::log10(before / now) - 2.0 / 3.0) <= 0.02);
    before = now;
  }
}

TEST_CASE("bristles that were bent go on pushing a gear that has locked itself") {
  const MeshParameters<double> p = table1();
  const double load = -1.0, torque = 0.01, rate = 0.05, off = 0.4, pull = 1.5;
  const Signal motor{{Step{0.15, 0.0}, Step{-0.15, off}, Ramp{.rate = rate, .start = pull}}};
  for (const By by : every_solver) {
    const auto seen = run(drive_with_states(GearMesh<double>(p), constant(load), motor, effects(bristles(torque, 0.5))),
                          Timetable(0, 6, 0.1), {}, tight(by, 1e-12));
    const auto start =
        std::find_if(seen.events.begin(), seen.events.end(), [&](const auto& e) { return e.after.t >= pull; });
    REQUIRE(start != seen.events.end());
    REQUIRE(start->before.mode.motion == Motion::stuck);
    const double h = deflection(start->before.x);
    REQUIRE(h > 0.1);
    const BreakInTorques needed = break_in_torques(GearMesh<double>(p), load);
    REQUIRE(std::abs(rate * (start->after.t - pull) - torque * h - *needed.forward) <= 1e-10);
  }
}

TEST_CASE("a gear that locks itself rests while its load passes zero, though bristles or a winding are integrated") {
  DcMotor<double> motor{1.2, 0.025};
  motor.inductance = 1e-3;
  for (const Effects<double>& on : {effects(bristles(0.01, 1.0)), effects(motor)})
    for (double phase = 0.0; phase < 360.0; phase += 20.0)
      for (const By by : every_solver) {
        const Signal load{{Sinusoid{.amplitude = 0.1, .frequency = 1.0, .phase = phase * unit::degree}}};
        const auto seen = run(drive_with_states(GearMesh<double>(table1()), load, Signal{}, on), Timetable(0, 2, 0.01),
                              {}, tight(by, 1e-10));
        INFO("phase " << phase << " deg");
        REQUIRE(seen.events.empty());
        REQUIRE(seen.end.x[0] == 0.0);
      }
}

TEST_CASE("without a load, where a gear starts as the switching surface is crossed, every solver has the same events") {
  DcMotor<double> motor{1.2, 0.025};
  for (const double inductance : {5e-2, 1e-2, 1.5e-3, 5e-4})
    for (const double phase : {-40.0, 10.0, 75.0}) {
      motor.inductance = inductance;
      const Signal push{{Sinusoid{.amplitude = 0.05, .frequency = 1.5, .phase = phase * unit::degree}}};
      const auto events = [&](By by) {
        return run(drive_with_states(GearMesh<double>(table1()), Signal{}, push,
                                     effects(motor, WormCoulomb<double>{0.02})),
                   Timetable(0, 2, 0.01), {}, tight(by, 1e-12))
            .modes();
      };
      INFO("inductance " << inductance << ", phase " << phase);
      REQUIRE(events(taylor) == events(bdf));
    }
}

}  // namespace wormdrive::test::events_worm_lugre
