#include <cmath>
#include <limits>
#include <numbers>

#include "catch.hpp"
#include "compliant_drives.hpp"
#include "description/build_control.hpp"
#include "support.hpp"

// Loads that add up, and the fan, whose torque has the sign of the motion.

namespace wormdrive::test::core_load_sum {

namespace {

GravityArm arm(double torque, double degrees, double inertia = 0.0) {
  GravityArm made;
  made.amplitude = torque;
  made.offset = degrees * unit::degree;
  made.own_inertia = inertia;
  return made;
}
const AngleTable table({-1.0, -0.2, 0.1, 0.5, 2.0}, {0.4, 0.4, -0.3, 0.6, 0.1});
const Fan fan{.rated_torque = 0.4, .rated_speed = 2.0, .own_inertia = 3e-4};
const LoadSum everything{{arm(0.3, 20, 1e-3), Constant{0.11}, Sinusoid{.amplitude = 0.2, .frequency = 3.0},
                          Step{.torque = 0.7, .time = 0.5}, table, arm(-0.1, 0, 2e-3), fan}};

constexpr double J = 0.02;

/// A free inertia under a constant torque and a fan alone, J theta'' = tau - k theta' |theta'|.
template <class Check>
void with_each_solver(double torque, double omega, double duration, Check&& check) {
  const Fan pure{.rated_torque = 0.4, .rated_speed = 2.0};
  const WormDrive<double, SummedLoad> wheel(GearMesh<double>::without_teeth(J), make_load(LoadSum{{pure}}), {},
                                            constant(torque));
  for (const By by : every_solver)
    check(run(wheel, Timetable(0.0, duration, 0.05), {0.0, {0.0, omega}, {}}, tight(by)));
}
constexpr double k = 0.4 / 4.0;  // [N m s^2/rad^2]

}  // namespace

TEST_CASE("a sum of loads has the torque, the inertia and the knots of its terms") {
  auto sum = make_load(everything);
  REQUIRE(std::abs(sum.inertia() - (1e-3 + 2e-3 + 3e-4)) <= 1e-18);
  REQUIRE(sum.next_knot(0.0) == 0.5);
  REQUIRE(sum.fastest() == 0.0);  // before it has entered
  sum.enter(0.2);
  REQUIRE(sum.fastest() == 2.0 * std::numbers::pi * 3.0);
  REQUIRE(sum.ripple() == make_load(table).ripple());
  for (const double t : {0.2, 0.5})
    for (const double theta : {-0.4, 0.3})
      for (const double omega : {-1.7, 0.0, 0.9}) {
        sum.enter(t);
        const double by_hand = 0.3 * std::cos(theta + 20 * unit::degree) + 0.11 +
                               0.2 * std::cos(2 * std::numbers::pi * 3.0 * t) + (t < 0.5 ? 0.0 : 0.7) +
                               make_load(table).torque(Moment<double>{t, theta, 0, 0}) - 0.1 * std::cos(theta) -
                               0.1 * omega * std::abs(omega);
        REQUIRE(std::abs(sum.torque(Moment<double>{t, theta, omega, 0.0}) - by_hand) <= 1e-15);
      }
}

TEST_CASE("where a series looks beyond a reversal the torque of a fan goes on as it is before it") {
  const SummedLoad load = make_load(LoadSum{{fan}});
  using Flow = Series<double, 2>;
  Flow omega(1e-3);
  omega[1] = -1.0;
  const Flow torque = load.torque(Moment<Flow>{Flow(0.0), Flow(0.0), omega, Flow(0.0)}, Motion::forward);
  REQUIRE(close(torque[2], -0.1, 1e-12));
  const Flow from_rest =
      load.torque(Moment<Flow>{Flow(0.0), Flow(0.0), Flow::variable(0.0), Flow(0.0)}, Motion::backward);
  REQUIRE(close(from_rest[2], 0.1, 1e-12));
}

TEST_CASE("a fan brakes a free inertia as 1/(1 + k w t/J), in both directions") {
  for (const double omega : {3.0, -3.0})
    with_each_solver(0.0, omega, 2.0, [&](const auto& run) {
      const double x = k * std::abs(omega) * 2.0 / J;
      REQUIRE(std::abs(run.end.x[1] - omega / (1.0 + x)) <= 1e-10);
      REQUIRE(std::abs(run.end.x[0] - std::copysign(J / k * std::log1p(x), omega)) <= 1e-10);
      REQUIRE(run.events.empty());
    });
}

TEST_CASE("a torque turns a fan up to the speed at which it takes all of it, as a hyperbolic tangent") {
  for (const double torque : {0.05, -0.05})
    with_each_solver(torque, 0.0, 0.7, [&](const auto& run) {
      const double most = std::sqrt(0.05 / k), rate = std::sqrt(0.05 * k) / J;
      REQUIRE(std::abs(run.end.x[1] - std::copysign(most * std::tanh(rate * 0.7), torque)) <= 1e-10);
      const double angle = J / k * std::log(std::cosh(rate * 0.7));
      REQUIRE(std::abs(run.end.x[0] - std::copysign(angle, torque)) <= 1e-10);
    });
}

TEST_CASE("a fan that is turned back reverses when the tangent is zero, and all solvers find that event") {
  const double omega = 1.5, most = std::sqrt(0.05 / k), rate = std::sqrt(0.05 * k) / J;
  const double reversal = std::atan(omega / most) / rate;
  for (const double side : {1.0, -1.0})
    with_each_solver(-0.05 * side, omega * side, 1.0, [&](const auto& run) {
      REQUIRE(run.events.size() == 1);
      REQUIRE(std::abs(run.events[0].after.t - reversal) <= 1e-10);
      REQUIRE(sign(run.events[0].after.mode.motion) == -side);
      REQUIRE(std::abs(side * run.end.x[1] + most * std::tanh(rate * (1.0 - reversal))) <= 1e-10);
    });
}

TEST_CASE("behind elastic teeth that do not touch, the gear alone drives its fan to and fro") {
  const double wide = 1e3;  // [rad], so that no flank is reached
  MeshParameters<double> p = unit_arms(clamped_shaft, J);
  const LoadSum load{{Fan{.rated_torque = 0.4, .rated_speed = 2.0}, Constant{-0.05}}};
  auto d = compliant(p, load, {}, {HuntCrossley<double>{1e6, 0.0}, wide});
  const double omega = 1.5, most = std::sqrt(0.05 / k), rate = std::sqrt(0.05 * k) / J;
  const double reversal = std::atan(omega / most) / rate;
  const auto run_of = run(d, Timetable(0.0, 1.0, 0.05), {0.0, {0.0, 0.0, 0.0, omega}, {}}, tight(bdf));
  REQUIRE(std::abs(run_of.end.x[3] + most * std::tanh(rate * (1.0 - reversal))) <= 1e-9);
}

TEST_CASE("a single load of its own kind stays what it was, and a sum is one only where it has to be") {
  REQUIRE(std::holds_alternative<Signal>(load_of({})));
  REQUIRE(std::holds_alternative<Signal>(load_of({Constant{1.0}, Ramp{.rate = 1.0}})));
  REQUIRE(std::holds_alternative<GravityArm>(load_of({arm(1.0, 0)})));
  REQUIRE(std::holds_alternative<LoadSum>(load_of({table})));
  REQUIRE(std::holds_alternative<LoadSum>(load_of({fan})));
  REQUIRE(std::holds_alternative<LoadSum>(load_of({arm(1.0, 0), Constant{1.0}})));
}

TEST_CASE("a controller's model takes arms and constants that add up for one arm and one constant") {
  Scenario scenario;
  scenario.mesh = table1();
  scenario.load = LoadSum{{arm(0.3, 20), arm(-0.1, 100), Constant{0.02}, Constant{0.03}}};
  const NominalModel model = exact_nominal(scenario);
  REQUIRE(is_estimable(scenario));
  for (const double theta : {-1.0, 0.0, 0.4, 2.0})
    REQUIRE(std::abs(model.load(theta) - (0.3 * std::cos(theta + 20 * unit::degree) -
                                          0.1 * std::cos(theta + 100 * unit::degree) + 0.05)) <= 1e-15);
  scenario.load = LoadSum{{arm(0.3, 20), fan}};
  REQUIRE(!is_estimable(scenario));
  REQUIRE(std::abs(exact_nominal(scenario).load_torque - 0.3) <= 1e-15);
}

}  // namespace wormdrive::test::core_load_sum
