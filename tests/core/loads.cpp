#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "core/load.hpp"
#include "core/numbers/series.hpp"
#include "core/unit.hpp"

namespace wormdrive::test::core_loads {

namespace {

Moment<double> at_angle(double theta_g) { return {0.0, theta_g, 0.0, 0.0}; }

GravityArm arm_of(double mass, double length) {
  GravityArm arm;
  arm.mass = mass;
  arm.arm = length;
  return arm;
}

}  // namespace

TEST_CASE("a mass on an arm loads with m g d and brings its own inertia m d^2") {
  const auto load = make_load(arm_of(1.0, 0.07));
  REQUIRE(std::abs(load.torque(at_angle(0.0)) - 0.69) <= 0.005);  // as printed with the paper's fig. 7
  REQUIRE(std::abs(load.torque(at_angle(0.0)) - 9.81 * 0.07) <= 1e-16);
  REQUIRE(load.inertia() == 1.0 * 0.07 * 0.07);
}

TEST_CASE("an arm stated by its torque has no inertia unless one is stated, and a stated one wins over m d^2") {
  GravityArm by_torque;
  by_torque.amplitude = 0.0196;
  REQUIRE(make_load(by_torque).inertia() == 0.0);
  by_torque.own_inertia = 0.0139;
  REQUIRE(make_load(by_torque).inertia() == 0.0139);

  GravityArm massless = arm_of(1.0, 0.07);
  massless.own_inertia = 0.0;
  REQUIRE(make_load(massless).inertia() == 0.0);
}

TEST_CASE("the angle offset turns the cosine into the paper's other load, a sine") {
  GravityArm arm;
  arm.amplitude = 0.0176;
  arm.offset = -90 * unit::degree;
  const auto load = make_load(arm);
  for (double theta : {-2.0, 0.0, 0.3, 1.5})
    REQUIRE(std::abs(load.torque(at_angle(theta)) - 0.0176 * std::sin(theta)) <= 1e-17);
}

TEST_CASE("an arm and a table depend on the angle alone, a timed load on time alone") {
  GravityArm arm;
  arm.amplitude = 1.0;
  auto gravity_load = make_load(arm);
  REQUIRE(gravity_load.next_knot(0.0) == std::numeric_limits<double>::infinity());
  REQUIRE(gravity_load.fastest() == 0.0);

  auto timed = make_load(Signal{{Step{.torque = 1.0, .time = 0.5}, Sinusoid{.amplitude = 0.1, .frequency = 3.0}}});
  REQUIRE(timed.next_knot(0.0) == 0.5);
  timed.enter(0.0);
  const auto before = timed.torque(Moment<double>{0.5, 9.0, 9.0, 9.0});
  timed.enter(0.5);
  const auto after = timed.torque(Moment<double>{0.5, -9.0, 0.0, 0.0});
  REQUIRE(std::abs(after - before - 1.0) <= 1e-15);
  REQUIRE(timed.fastest() == 2.0 * std::numbers::pi * 3.0);
}

TEST_CASE("an angle table hits its points, holds its ends and is smooth everywhere") {
  const std::vector<double> angles{-1.0, -0.2, 0.1, 0.5, 2.0}, torques{0.4, 0.4, -0.3, 0.6, 0.1};
  const AngleTable load(angles, torques);
  for (std::size_t k = 0; k < angles.size(); ++k)
    REQUIRE(std::abs(load.torque(at_angle(angles[k])) - torques[k]) <= 1e-15);
  REQUIRE(load.torque(at_angle(-50.0)) == 0.4);
  REQUIRE(load.torque(at_angle(50.0)) == 0.1);

  // slope by the series that the solvers' derivatives use, from both sides of each point
  const auto slope = [&](double theta) {
    using Flow = Series<double, 1>;
    return load.torque(Moment<Flow>{Flow(0.0), Flow::variable(theta), Flow(0.0), Flow(0.0)})[1];
  };
  for (double angle : angles) {
    const double left = slope(angle - 1e-9), right = slope(angle + 1e-9);
    REQUIRE(std::abs(left - right) <= 1e-6);
    REQUIRE(std::abs(load.torque(at_angle(angle - 1e-9)) - load.torque(at_angle(angle + 1e-9))) <= 1e-7);
  }
}

TEST_CASE("a table gives back what is no number, and its end values beyond its points") {
  const CubicTable table({0.0, 1.0, 2.0, 3.0}, {5.0, 6.0, 4.0, 7.0});
  REQUIRE(std::isnan(table(std::numeric_limits<double>::quiet_NaN())));
  for (const double x : {-std::numeric_limits<double>::infinity(), -1.0, 0.0}) REQUIRE(table(x) == 5.0);
  for (const double x : {3.0, 4.0, std::numeric_limits<double>::infinity()}) REQUIRE(table(x) == 7.0);
}

TEST_CASE("an angle table is monotone between its points: a flat pair stays flat and no torque is overshot") {
  const AngleTable load({-1.0, -0.2, 0.1, 0.5, 2.0}, {0.4, 0.4, -0.3, 0.6, 0.1});
  double lowest = 1.0, highest = -1.0, off_the_flat = 0.0;
  for (double theta = -1.0; theta <= 2.0; theta += 1e-3) {
    const double torque = load.torque(at_angle(theta));
    lowest = std::min(lowest, torque);
    highest = std::max(highest, torque);
    if (theta <= -0.2) off_the_flat = std::max(off_the_flat, std::abs(torque - 0.4));
  }
  REQUIRE(lowest >= -0.3 - 1e-15);
  REQUIRE(highest <= 0.6 + 1e-15);
  REQUIRE(off_the_flat <= 1e-15);
}

}  // namespace wormdrive::test::core_loads
