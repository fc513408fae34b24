#include "control/position_servo.hpp"

#include <cmath>
#include <complex>
#include <vector>

#include "catch.hpp"
#include "control/closed_loop.hpp"
#include "support.hpp"

// The servo that takes positions: its law by hand, and the free inertia that it makes an oscillator.

namespace wormdrive::test::control_position_servo {

TEST_CASE(
    "the servo pulls in proportion to what is left, against the speed, within its limit and beyond its dead band") {
  const PositionServo servo({.gain = 2.0, .damping = 0.1, .limit = 0.5, .dead_band = 0.01});
  const auto torque = [&](double angle, double speed) {
    return servo({0.0, angle, speed, 0.0, {1.0, 9.0, 9.0}}).torque;
  };
  REQUIRE(close(torque(0.9, 0.0), 0.2, 1e-14));
  REQUIRE(close(torque(0.9, 0.5), 0.15, 1e-14));
  REQUIRE(close(torque(1.2, -1.0), -0.3, 1e-14));
  REQUIRE(torque(0.0, 0.0) == 0.5);
  REQUIRE(torque(3.0, 0.0) == -0.5);
  REQUIRE(torque(0.995, 0.0) == 0.0);
  REQUIRE(close(torque(1.005, 0.3), -0.03, 1e-14));
}

TEST_CASE("under the servo a free inertia is a sampled oscillator") {
  const double J = 2e-3, K = 1.1, D = 0.02, T = 2e-3, goal = 0.3;
  SensorSettings exact;
  exact.exact_speed = true;
  std::vector<double> angles;
  ClosedLoop loop(PositionServo({.gain = K, .damping = D}), Reference{{StepReference{goal, 0.0}}}, exact,
                  SamplingSettings{.period = T}, DisturbanceSettings{},
                  [&](const ControlRecord& r) { angles.push_back(r.gear_angle); });
  run(WormDrive<double, TimedLoad>(GearMesh<double>::without_teeth(J), make_load(Signal{}), {}, {}),
      Timetable(0.0, 1.0, 0.5, {T, 0.0}), {0.0, {0.0, 0.0}, {}}, tight(taylor), loop);
  // x(k+1) = A x(k) of e and e' with tau = -K e - D e', held: e(k) = Re(c z^k) with the roots z of A
  const double h = T * T / (2 * J), v = T / J;
  const double a = 1 - h * K, b = T - h * D, c = -v * K, d = 1 - v * D;
  const std::complex<double> z = 0.5 * (a + d) + std::sqrt(std::complex<double>(0.25 * (a - d) * (a - d) + b * c));
  REQUIRE(z.imag() > 0.0);
  // e(0) = -goal, e(1) = a e(0)
  const double e0 = -goal, e1 = a * e0;
  const std::complex<double> amplitude(e0, (e0 * z.real() - e1) / z.imag());
  REQUIRE(angles.size() == 500);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const double e = (amplitude * std::pow(z, static_cast<double>(k))).real();
    REQUIRE(std::abs(angles[k] - goal - e) <= 1e-10);
  }
}

}  // namespace wormdrive::test::control_position_servo
