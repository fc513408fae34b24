#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "near_ties/dice.hpp"
#include "support.hpp"

// Bends of the equations that a long step could pass over, or that lie where a run begins: energy that is conserved,
// and motions by hand.

namespace wormdrive::test::events_bends {

namespace {

/// A load over time, or a sum, on a drive.
template <class Load>
auto on(const GearMesh<double>& mesh, const Load& load, const Signal& motor, double share = 0.0) {
  using Made = decltype(make_load(load));
  const Effects<double> rubs = share > 0.0 ? effects(FrictionUnderLoad<double>{share}) : Effects<double>{};
  return WormDrive<double, Made>(mesh, make_load(load), rubs, motor);
}

}  // namespace

TEST_CASE("a body that turns just behind a stop meets the stop, however short the way into it is") {
  near_ties::Dice dice(3, 0);
  const double tolerance = 1e-11;
  for (int drawn = 0; drawn < 60; ++drawn) {
    // thrown up with 1 rad/s under 1 rad/s^2 it would turn at 0.5 rad
    const double depth = dice.decades(1e-6, 0.06), stiffness = dice.decades(1e3, 1e7), duration = dice.decades(2, 100);
    EndStops stop;
    stop.high = 0.5 - depth;
    stop.stiffness = stiffness;
    const auto d = on(GearMesh<double>::without_teeth(1.0), LoadSum{{Constant{-1.0}, stop}}, Signal{});
    for (const By by : every_solver) {
      const auto seen = run(d, Timetable(0, duration, duration), {0, {0.0, 1.0}, {}}, tight(by, tolerance));
      INFO("solver " << int(by.solver) << ", depth " << depth << ", stiffness " << stiffness << ", duration "
                     << duration);
      REQUIRE(seen.events.size() == 1);
      const double energy = 0.5 * seen.end.x[1] * seen.end.x[1] + seen.end.x[0];
      REQUIRE(std::abs(energy - 0.5) <= 1e-8 * (1.0 + std::abs(seen.end.x[0])));
      const double deepest = seen.events[0].after.x[0] - *stop.high;
      // 1/2 k d^2 = what is left of the rise
      REQUIRE(std::abs(0.5 * stiffness * deepest * deepest + deepest - depth) <= 1e-7 * depth + 10.0 * tolerance);
    }
  }
}

TEST_CASE("a load that just balances its own friction half of the time is not taken for one that always does") {
  const double pi = std::acos(-1.0);
  for (const double frequency : {1.0, 0.37, 12.9}) {
    const Signal load{{Sinusoid{.amplitude = 1.0, .frequency = frequency, .phase = -0.5 * pi}}}, motor = constant(0.1);
    const double end = 16.0 / frequency;
    const auto bdf_run =
        run(on(GearMesh<double>::without_teeth(1.0), load, motor, 1.0), Timetable(0, end, end), {}, tight());
    const auto series =
        run(on(GearMesh<double>::without_teeth(1.0), load, motor, 1.0), Timetable(0, end, end), {}, tight(taylor));
    REQUIRE(bdf_run.events.size() == 32);
    REQUIRE(series.events.size() == 32);
    // by fixed steps of a millionth of the run
    double angle = 0.0, speed = 0.0;
    constexpr int steps = 1'000'000;
    const double h = end / steps;
    for (int k = 0; k < steps; ++k) {
      const double tau = std::sin(2.0 * pi * frequency * (k + 0.5) * h), free = speed + h * (0.1 + tau);
      speed = std::copysign(std::max(0.0, std::abs(free) - h * std::abs(tau)), free);
      angle += h * speed;
    }
    REQUIRE(std::abs(series.end.x[0] - angle) <= 1e-5 * std::abs(angle));
    REQUIRE(std::abs(bdf_run.end.x[0] - series.end.x[0]) <= 1e-9 * std::abs(angle));
  }
}

TEST_CASE("where a run begins at a bend, the mode is that of the side it goes to") {
  const MeshParameters<double> p = table1(0.1);
  const double share = 0.5, rate = -0.6, load_rate = -1.0, end = 0.01;
  const auto d = on(GearMesh<double>(p), Signal{{Ramp{.rate = load_rate}}}, Signal{{Ramp{.rate = rate}}}, share);
  for (const By by : every_solver) {
    const auto seen = run(d, Timetable(0, end, end), {0, {0.0, 1.0}, {}}, tight(by));
    for (const auto& row : seen.rows) REQUIRE(row.now.mode.motion == Motion::forward);
    REQUIRE(seen.events.empty());
    const Branch branch(p, seen.end.mode);
    const double jerk = branch.acceleration(rate, load_rate * (1.0 + share));
    REQUIRE(std::abs(seen.end.x[1] - (1.0 + 0.5 * jerk * end * end)) <= 1e-11);
    REQUIRE(std::abs(seen.end.x[0] - (end + jerk * end * end * end / 6.0)) <= 1e-11);
  }
  EndStops stop;
  stop.high = 0.0;
  stop.stiffness = 1000.0;
  for (const By by : every_solver) {
    const auto seen = run(on(GearMesh<double>::without_teeth(1e-3), LoadSum{{stop}}, Signal{}),
                          Timetable(0, 0.02, 0.02), {0, {0.0, 5.0}, {}}, tight(by, 1e-12));
    REQUIRE(seen.events.size() == 1);
    const double contact = std::acos(-1.0) / 1000.0;
    REQUIRE(std::abs(seen.end.x[0] + 5.0 * (0.02 - contact)) <= 1e-9);
  }
}

TEST_CASE(
    "friction under the load of a damped stop alone has the same events by every solver, where the load is zero") {
  near_ties::Dice dice(31, 0);
  for (int drawn = 0; drawn < 12; ++drawn) {
    const double mu = dice.between(0.03, 0.1), ratio = std::round(dice.between(20.0, 50.0)),
                 lead = dice.between(10.0, 25.0) * unit::degree;
    MeshParameters<double> p = closing(table1(mu), ratio, lead);
    p.Jw = dice.decades(1e-6, 1e-5);
    p.Jg = dice.decades(1e-5, 1e-4);
    EndStops stops;
    stops.low = -dice.between(0.3, 1.0);
    stops.high = dice.between(0.3, 1.0);
    stops.stiffness = dice.decades(0.3, 30.0);
    stops.damping = dice.decades(0.1, 3.0);
    const Signal push{{Sinusoid{.amplitude = 0.004, .frequency = dice.between(1.0, 8.0), .phase = -1.0},
                       Sinusoid{.amplitude = 0.004, .frequency = 0.8, .phase = 0.3}}};
    const auto d = on(GearMesh<double>(p), LoadSum{{stops}}, push, dice.between(0.02, 0.3));
    const auto seen = [&](By by) { return run(d, Timetable(0, 1, 0.1), {0, {0.0, 0.2}, {}}, tight(by, 1e-11)); };
    INFO("drawn " << drawn);
    const auto series = seen(taylor), steps = seen(bdf);
    REQUIRE(series.modes() == steps.modes());
    REQUIRE(std::abs(series.end.x[0] - steps.end.x[0]) <= 1e-6);
  }
}

TEST_CASE("a load that turns ever so slowly one way and is pulled the other way gets across its bend") {
  // It hangs on a gear that starts, so that the speed of the load grows with the third power of time; its own torque
  // bends where it turns.
  near_ties::Dice dice(20261129, 0);
  Fan fan;
  fan.rated_torque = 0.1;
  fan.rated_speed = 1.0;
  constexpr int twist = 2 + int{StateLayout<EffectList<double>>::first<LoadCoupling<double>>()};
  for (int drawn = 0; drawn < 40; ++drawn) {
    const double push = dice.sign() * dice.decades(1e-2, 10.0), start = dice.decades(1e-3, 1e3);
    const LoadCoupling<double> coupling{dice.decades(1e-3, 1.0), dice.decades(0.1, 100.0)};
    const auto end_with = [&](double speed, By by) {
      auto d =
          drive_with_states(GearMesh<double>::without_teeth(1.0), LoadSum{{fan}}, constant(push), effects(coupling));
      d.enter(start);
      typename decltype(d)::Instant from{start};
      from.x[twist + 1] = speed;
      return run(d, Timetable(start, start + 0.5, 0.5), from, tight(by, 1e-10)).end.x;
    };
    for (const By by : every_solver) {
      const auto expected = end_with(0.0, by);
      const double speed = -dice.decades(1e-300, 1e-12) * (push > 0.0 ? 1.0 : -1.0);
      INFO("solver " << int(by.solver) << ", load speed " << speed << ", push " << push << ", from " << start << " s");
      REQUIRE((end_with(speed, by) - expected).norm() <= 1e-7 * expected.norm());
    }
  }
}

}  // namespace wormdrive::test::events_bends
