#include <cmath>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "support.hpp"

// Friction that grows with the load, against what a pendulum and a winch make of it on paper.

namespace wormdrive::test::events_friction_under_load {

namespace {

/// One inertia without teeth.
template <class Load>
auto single(double J, const Load& load, const Signal& motor, double share) {
  using Made = decltype(make_load(load));
  return WormDrive<double, Made>(GearMesh<double>::without_teeth(J), make_load(load),
                                 effects(FrictionUnderLoad<double>{share}), motor);
}

/// An arm that hangs down at angle zero.
GravityArm pendulum(double torque) {
  GravityArm arm;
  arm.amplitude = torque;
  arm.offset = 0.5 * std::numbers::pi;
  return arm;
}

}  // namespace

TEST_CASE("a pendulum whose friction grows with its load rises by the same share of every fall, and never stops") {
  // down with (1 - share) of its weight, up with (1 + share) of it, whatever the height
  for (const double share : {0.02, 0.3, 0.7})
    for (const double J : {1e-6, 2e-3, 4.0})
      for (const By by : every_solver) {
        const double torque = 50.0 * J, start = 1.9;
        const double kept = (1.0 - share) / (1.0 + share);
        const auto seen = run(single(J, pendulum(torque), Signal{}, share), Timetable(0, 3, 0.1), {0, {start, 0.0}, {}},
                              tight(by, by.solver == SolverKind::taylor ? 1e-12 : 1e-13));
        double height = 1.0 - std::cos(start);
        int turns = 0;
        for (const auto& e : seen.events) {
          REQUIRE(e.after.mode.motion != Motion::stuck);
          if (e.before.mode.motion == Motion::stuck) continue;
          height *= kept;
          const double found = 2.0 * std::pow(std::sin(0.5 * e.after.x[0]), 2);
          INFO("turn " << ++turns << " with share " << share << " and J " << J);
          REQUIRE(std::abs(found - height) <= 1e-9 * height + 1e-12);
        }
        REQUIRE(seen.events.size() >= 4);
      }
}

TEST_CASE("a winch with friction that grows with its load holds what 1 - share of it cannot move") {
  const double load = -0.4, share = 0.25, J = 1e-3, rate = 0.1;
  for (const By by : every_solver) {
    const Signal rising{{Constant{0.4}, Ramp{.rate = rate}}}, falling{{Constant{0.4}, Ramp{.rate = -rate}}};
    const auto lifts = run(single(J, constant(load), rising, share), Timetable(0, 2, 0.1), {}, tight(by));
    REQUIRE(lifts.events.size() == 1);
    REQUIRE(lifts.events[0].after.mode.motion == Motion::forward);
    REQUIRE(std::abs(lifts.events[0].after.t - share * 0.4 / rate) <= 1e-14);
    const double s = 2.0 - lifts.events[0].after.t;
    REQUIRE(std::abs(lifts.end.x[1] - 0.5 * rate * s * s / J) <= 1e-9);
    const auto lowers = run(single(J, constant(load), falling, share), Timetable(0, 2, 0.1), {}, tight(by));
    REQUIRE(lowers.events.size() == 1);
    REQUIRE(lowers.events[0].after.mode.motion == Motion::backward);
    REQUIRE(std::abs(lowers.events[0].after.t - share * 0.4 / rate) <= 1e-14);
  }
}

TEST_CASE("behind teeth the four equations hold with the load less its friction") {
  const MeshParameters<double> p = table1();
  const double share = 0.3, tau_m = 0.05;
  for (const double tau_l : {-0.4, 0.2})
    for (const Mode mode : moving_modes) {
      const auto d = entered(p, constant(tau_l), constant(tau_m), effects(FrictionUnderLoad<double>{share}));
      const double left = tau_l - sign(mode.motion) * share * std::abs(tau_l);
      const double expected = Branch(p, mode).acceleration(tau_m, left);
      REQUIRE(std::abs(d.acceleration(d.moment(0.0, 0.3, 1.0 * sign(mode.motion)), mode) - expected) <=
              1e-13 * std::abs(expected));
    }
}

}  // namespace wormdrive::test::events_friction_under_load
