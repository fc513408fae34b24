#include <cmath>

#include "catch.hpp"
#include "support.hpp"

// Friction at rest above that of sliding: when the gear breaks away, and with what acceleration.

namespace wormdrive::test::core_effects_rest {

namespace {

const GearMesh<double> mesh(table1());
constexpr double tau_l = 0.5, rate = 0.02;  // load [N m], fall of the motor torque [N m/s]

/// A held load that the motor pushes backward harder and harder: it starts when rate t = C(-mu_s) tau_l.
auto pushed(const StaticFriction<double>& at_rest) {
  return drive(table1(), constant(tau_l), {{Ramp{.rate = -rate, .start = 0.0, .end = 10.0}}}, effects(at_rest));
}
double breaks_away(double mu_s) { return mesh.C(-mu_s) * tau_l / rate; }

}  // namespace

TEST_CASE("static_friction: the gear breaks away at mu + rise, and then slides with mu: the acceleration jumps") {
  for (const By by : every_solver) {
    const auto result = run(pushed({.rise = 0.05}), Timetable(0, 4, 1.0), {}, tight(by));
    REQUIRE(result.events.size() == 1);
    REQUIRE(close(result.events[0].after.t, breaks_away(0.30), 1e-11));
    const Mode lifting{Motion::backward, Flank::left};
    REQUIRE(result.events[0].after.mode == lifting);
    const Branch branch(table1(), lifting);
    const double before = -breaks_away(0.30) * rate;
    const auto d = [&] {
      auto moved = pushed({.rise = 0.05});
      moved.enter(result.events[0].after.t);
      return moved;
    }();
    REQUIRE(close(d.observe(result.events[0].after).alpha_g, branch.acceleration(before, tau_l), 1e-9));
    REQUIRE(branch.acceleration(before, tau_l) < -0.1);
  }
}

TEST_CASE("static_friction: with a growth time it hangs on how long the gear has been at rest") {
  const double rise = 0.1, growth = 1.5;
  // rate t = C(-mu_s(t)) tau_l, by bisection
  double low = 0.0, high = 10.0;
  for (int k = 0; k < 100; ++k) {
    const double t = 0.5 * (low + high), mu_s = 0.25 + rise * (1.0 - std::exp(-t / growth));
    (rate * t < mesh.C(-mu_s) * tau_l ? low : high) = t;
  }
  for (const By by : every_solver) {
    const auto result = run(pushed({.rise = rise, .growth_time = growth}), Timetable(0, 5, 1.0), {}, tight(by));
    REQUIRE(result.events.size() == 1);
    REQUIRE(std::abs(result.events[0].after.t - low) <= 1e-11);
    REQUIRE(low > breaks_away(0.25) + 0.1);
  }
}

TEST_CASE("static_friction: a gear that has just come to rest holds no better than one that slides") {
  // A load that would slip at mu but not at mu + rise, and a gear that stops: with a growth time it turns at once.
  const Signal motor = constant(-mesh.C(-0.26) * tau_l);  // lifts against mu, not against mu + 0.05
  for (const By by : every_solver) {
    const auto start = decltype(drive(table1(), constant(tau_l), motor))::Instant{0.0, {0.0, 0.05}, {}};
    const auto at_once = run(drive(table1(), constant(tau_l), motor, effects(StaticFriction<double>{.rise = 0.05})),
                             Timetable(0, 1, 0.5), start, tight(by));
    REQUIRE(at_once.end.mode.motion == Motion::stuck);
    const auto grown = run(drive(table1(), constant(tau_l), motor, effects(StaticFriction<double>{0.05, 0.3})),
                           Timetable(0, 1, 0.5), start, tight(by));
    REQUIRE(grown.end.mode.motion == Motion::backward);
    const auto without = run(drive(table1(), constant(tau_l), motor), Timetable(0, 1, 0.5), start, tight(by));
    REQUIRE((grown.end.x - without.end.x).cwiseAbs().maxCoeff() <= 1e-12);
  }
}

TEST_CASE("static_friction: time at rest counts from the latest stop") {
  // Stops at about 0.02 s, is held, and is pushed on at 1.0 s: what it withstands then has grown for the time between.
  const double rise = 0.1, growth = 1.0;
  const Signal motor{{Step{.torque = -0.012, .time = 1.0}}};
  const auto d = drive(table1(), constant(tau_l), motor, effects(StaticFriction<double>{rise, growth}));
  for (const By by : every_solver) {
    const auto result = run(d, Timetable(0, 1.2, 0.1), {0.0, {0.0, 0.5}, {}}, tight(by));
    REQUIRE_FALSE(result.events.empty());
    const double stop = result.events[0].after.t;
    REQUIRE((result.events[0].after.mode.motion == Motion::stuck && stop > 0.001));
    REQUIRE(result.events[0].after.since == stop);
    auto there = d;
    there.enter(0.5);
    auto held = result.events[0].after;
    held.t = 0.5;
    const double mu_s = 0.25 + rise * (1.0 - std::exp(-(0.5 - stop) / growth));
    const Branch branch(table1(mu_s), {Motion::backward, Flank::left});
    REQUIRE(close(there.guards(there.moment(held), held.mode)[1], branch.acceleration(0.0, tau_l), 1e-12));
  }
}

}  // namespace wormdrive::test::core_effects_rest
