#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "support.hpp"

// Friction and loads that tables give, and what shakes the drive in time, each against a closed form.

namespace wormdrive::test::core_effects_maps {

namespace {

constexpr double J = 2.0;
const GearMesh<double> mesh(table1());

/// A flywheel of 2 kg m^2 without a gear: worm and gear are one.
auto flywheel(double load, const Effects<double>& on) {
  using Made = decltype(make_load(constant(load)));
  return WormDrive<double, Made>(GearMesh<double>::without_teeth(J), make_load(constant(load)), on, constant(0.0));
}

/// A line through the origin: straight up to the last but one of its points.
CubicTable line(double slope, double half_length) {
  std::vector<double> x, y;
  for (int k = -4; k <= 4; ++k) {
    x.push_back(0.25 * k * half_length);
    y.push_back(slope * x.back());
  }
  return {x, y};
}

double friction(const FrictionMap<double>& map, double t, double theta_g, double omega_g, Motion motion) {
  const auto d = entered(table1(), constant(0.0), constant(0.0), effects(map));
  return d.friction(d.moment(t, theta_g, omega_g), motion);
}

}  // namespace

TEST_CASE("friction_map: shares of the mesh's friction, or coefficients in its place, over speed, angle or time") {
  using enum FrictionAxis;
  using enum FrictionValue;
  const CubicTable table({0.0, 0.2, 0.5, 1.0}, {0.3, 0.2, -0.1, 0.1});
  const double omega_g = 0.5 * std::cos(mesh.lambda) / mesh.lw / mesh.i;  // the teeth slide 0.5 m/s
  for (const Motion motion : {Motion::forward, Motion::backward}) {
    const double way = sign(motion) * omega_g;
    REQUIRE(close(friction({sliding_speed, share, 1.0, table}, 0.0, 0.0, way, motion), 0.25 * 0.9, 1e-14));
    REQUIRE(close(friction({sliding_speed, coefficient, 0.5, table}, 0.0, 0.0, 0.4 * way, motion), 0.1, 1e-14));
    REQUIRE(close(friction({gear_angle, share, 2.0, table}, 9.0, 0.2, way, motion), 0.25 * 1.4, 1e-14));
    REQUIRE(close(friction({time, coefficient, 1.0, table}, 0.2, 9.0, way, motion), 0.2, 1e-14));
  }
  REQUIRE(close(friction({sliding_speed, share, 1.0, table}, 0.0, 0.0, 0.0, Motion::stuck), 0.25 * 1.3, 1e-14));
  const FrictionRange of_shares = FrictionMap<double>{time, share, -1.0, table}.friction_range({0.2, 0.3}, 1.0);
  REQUIRE(close(of_shares.low, 0.2 * 0.7, 1e-15));
  REQUIRE(close(of_shares.high, 0.3 * 1.1, 1e-15));
  const FrictionRange of_coefficients =
      FrictionMap<double>{time, coefficient, 2.0, table}.friction_range({0.2, 0.3}, 1.0);
  REQUIRE(close(of_coefficients.low, -0.2, 1e-15));
  REQUIRE(close(of_coefficients.high, 0.6, 1e-15));
}

TEST_CASE("friction_map: a held load slips when friction over the time has fallen to mu_w") {
  const double slope = -0.9, slips = (mesh.mu_w() / 0.25 - 1.0) / slope;
  const auto d = drive(table1(), constant(0.5), constant(0.0),
                       effects(FrictionMap<double>{FrictionAxis::time, FrictionValue::share, 1.0, line(slope, 2.0)}));
  for (const By by : every_solver) {
    const auto result = run(d, Timetable(0, 0.99, 0.1), {}, tight(by));
    REQUIRE(result.events.size() == 1);
    REQUIRE(result.events[0].after.mode == Mode{Motion::forward, Flank::left});
    REQUIRE(std::abs(result.events[0].after.t - slips) <= 1e-12);
  }
}

TEST_CASE("load_map: a load that grows with the time, or with the angle, by what its table says") {
  const double load = 0.4, slope = 0.6;
  const CubicTable grows = line(slope, 8.0);
  const double over_time = load / J * (1.0 + 0.5 * slope);
  const double rate = std::sqrt(load * slope / J), over_angle = rate * std::sinh(rate) / slope;
  for (const By by : every_solver) {
    const auto speed = [&](LoadAxis over) {
      return run(flywheel(load, effects(LoadMap<double>{over, 1.0, grows})), Timetable(0, 1, 0.25),
                 {0.0, {0.0, 0.0}, {}}, tight(by))
          .end.x[1];
    };
    REQUIRE(close(speed(LoadAxis::time), over_time, 1e-11));
    REQUIRE(close(speed(LoadAxis::gear_angle), over_angle, 1e-11));
  }
}

TEST_CASE("vibration: a flywheel that it shakes, and torque_map over the time with the same torque") {
  const double A = 0.3, f = 7.0, phase = 0.4, omega = 2.0 * std::numbers::pi * f;
  const double start = A / (J * omega);  // more than it takes to turn forward throughout
  const double end = 3.0 * start + A / (J * omega) * (std::cos(phase) - std::cos(0.9 * omega + phase));
  const auto speed = [&](By by, const Effects<double>& on) {
    return run(flywheel(0.0, on), Timetable(0, 0.9, 0.1), {0.0, {0.0, 3.0 * start}, {}}, tight(by)).end.x[1];
  };
  std::vector<double> t, torque;
  for (int k = 0; k <= 2000; ++k) {
    t.push_back(5e-4 * k);
    torque.push_back(A * std::sin(omega * t.back() + phase));
  }
  for (const By by : every_solver) {
    REQUIRE(close(speed(by, effects(Vibration<double>{A, f, phase})), end, 1e-10));
    REQUIRE(close(speed(by, effects(TorqueMap<double>{MapAxis::time, 1.0, CubicTable(t, torque)})), end, 1e-5));
  }
}

TEST_CASE("vibration: a gear at rest breaks away at the first crest beyond break-in, however short it is") {
  const double load = 0.5, offset = 0.01;  // the motor holds less than the load pulls
  const auto holds = [&](double torque) {
    const auto d = entered(table1(), constant(load), constant(torque));
    return d.guards(d.moment(0.0, 0.0, 0.0), {});
  };
  // where a motor torque moves the gear forward: the margin is linear in the torque
  const double at_0 = holds(0.0)[0], slope = holds(1.0)[0] - at_0, break_in = -at_0 / slope;
  for (const double f : {0.3, 3.0, 40.0, 700.0})
    for (const double above : {1.3, 1.0 + 1e-4}) {
      const double A = above * (break_in - offset), omega = 2.0 * std::numbers::pi * f;
      const double leaves = std::asin(1.0 / above) / omega;
      const auto d = drive(table1(), constant(load), constant(offset), effects(Vibration<double>{A, f, 0.0}));
      for (const By by : every_solver) {
        INFO(f << " Hz, " << above << " of what it takes");
        const auto result = run(d, Timetable(0, 7.3 / f, 7.3 / f), {}, tight(by));
        REQUIRE(result.events.size() >= 1);
        REQUIRE(std::abs(result.events[0].after.t - leaves) <= 1e-6 / f);
      }
    }
}

}  // namespace wormdrive::test::core_effects_maps
