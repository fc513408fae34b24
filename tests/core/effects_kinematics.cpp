#include <cmath>

#include "catch.hpp"
#include "core/energy.hpp"
#include "core/steady.hpp"
#include "support.hpp"

// An uneven pitch, theta_w = i (theta_g + A sin(theta_g + p)), against energy and against the two balances it joins.

namespace wormdrive::test::core_effects_kinematics {

namespace {

constexpr double A = 0.02, p = 0.7, i = 60.0;
const Effects<double> uneven = effects(TransmissionError<double>{A, p});

double slope(double theta_g) { return 1.0 + A * std::cos(theta_g + p); }
double curvature(double theta_g) { return -A * std::sin(theta_g + p); }

}  // namespace

TEST_CASE("transmission_error: the worm runs ahead of the gear by i A sin(theta_g + p)") {
  const auto d = entered(table1(), constant(0.0), constant(0.0), uneven);
  const Moment<double> at = d.moment(0.0, 0.4, 1.5);
  REQUIRE(close(at.theta_w, i * (0.4 + A * std::sin(1.1)), 1e-15));
  REQUIRE(close(at.omega_w, i * 1.5 * (1.0 + A * std::cos(1.1)), 1e-15));
}

TEST_CASE("transmission_error: without friction and torques the kinetic energy of both shafts stays") {
  const MeshParameters<double> smooth = closing(table1(0.0));
  const auto d = drive(smooth, constant(0.0), constant(0.0), uneven);
  const auto speed = [&](double theta_g) {
    const double w = i * slope(theta_g);
    return std::sqrt(smooth.Jw * w * w + smooth.Jg);
  };
  for (const By by : every_solver)
    for (const auto& row : run(d, Timetable(0, 2, 0.1), {0.0, {0.3, 4.0}, {}}, tight(by)).rows)
      REQUIRE(close(row.now.x[1], 4.0 * speed(0.3) / speed(row.now.x[0]), 1e-11));
}

TEST_CASE("transmission_error: without friction all work of motor and load is kinetic energy") {
  const MeshParameters<double> smooth = closing(table1(0.0));
  const double tau_m = 0.01, tau_l = -0.3;
  const auto d = drive(smooth, constant(tau_l), constant(tau_m), uneven);
  for (const By by : every_solver) {
    const auto result = run(d, Timetable(0, 1, 0.1), {0.0, {0.3, 1.0}, {}}, tight(by));
    const auto &from = result.rows.front().now, &to = result.end;
    const double work = tau_m * (d.moment(to).theta_w - d.moment(from).theta_w) + tau_l * (to.x[0] - from.x[0]);
    REQUIRE(std::abs(work) >= 0.1);
    REQUIRE(close(stored_energy(d, to) - stored_energy(d, from), work, 1e-10));
  }
}

TEST_CASE("transmission_error: with friction motor and load pay for it and for kinetic energy, and nothing else") {
  const MeshParameters<double> rough = closing(table1());
  const auto d = entered(rough, constant(0.2), constant(0.01), uneven);
  for (const Motion motion : {Motion::forward, Motion::backward})
    for (const double theta_g : {-2.0, 0.4, 1.9}) {
      auto now = decltype(d)::Instant{0.0, {theta_g, 3.0 * sign(motion)}, {}};
      now.mode = d.settle(now);
      const double omega = now.x[1], alpha = d.observe(now).alpha_g, k = slope(theta_g);
      const double alpha_w = i * (k * alpha + curvature(theta_g) * omega * omega);
      const double gained = rough.Jw * i * k * omega * alpha_w + rough.Jg * omega * alpha;
      const Power flow = power(d, now);
      REQUIRE(flow.loss > 0.0);
      REQUIRE(std::abs(flow.motor + flow.load - flow.loss - gained) <=
              1e-12 * (std::abs(flow.motor) + std::abs(flow.load)));
    }
}

TEST_CASE("transmission_error: the acceleration and the normal force solve the balances of both shafts") {
  const MeshParameters<double> table = table1();
  const GearMesh<double> mesh(table);
  for (const Mode mode : moving_modes)
    for (const double theta_g : {-2.0, 0.4, 1.9}) {
      const double omega = 3.0 * sign(mode.motion), tau_l = 0.2, tau_m = 0.01;
      const auto d = entered(table, constant(tau_l), constant(tau_m), uneven);
      const auto seen = d.observe({0.0, {theta_g, omega}, mode});
      const double m = mode.product() * mesh.mu, push = sign(mode.flank) * seen.normal_force;
      const double alpha_w = i * (slope(theta_g) * seen.alpha_g + curvature(theta_g) * omega * omega);
      // gear: Jg theta_g'' = tau_l - push gear_arm;  worm: Jw theta_w'' = tau_m + push worm_arm / k
      REQUIRE(std::abs(mesh.Jg * seen.alpha_g - tau_l + push * mesh.gear_arm(m)) <= 1e-13);
      REQUIRE(std::abs(mesh.Jw * alpha_w - tau_m - push * mesh.worm_arm(m) / slope(theta_g)) <= 1e-13);
    }
}

TEST_CASE("transmission_error: at the switching surface no flank pushes, and the acceleration is tau_l/Jg") {
  const MeshParameters<double> table = table1();
  const double theta_g = 0.9, omega = 2.5, tau_l = 0.2;
  const double tau_m = table.Jw * i * (slope(theta_g) * tau_l / table.Jg + curvature(theta_g) * omega * omega);
  const auto d = entered(table, constant(tau_l), constant(tau_m), uneven);
  REQUIRE(std::abs(d.beyond_surface(d.moment(0.0, theta_g, omega), Motion::forward)) <= 1e-16);
  for (const Flank flank : {Flank::left, Flank::right}) {
    const auto seen = d.observe({0.0, {theta_g, omega}, {Motion::forward, flank}});
    REQUIRE(close(seen.alpha_g, tau_l / table.Jg, 1e-13));
    REQUIRE(std::abs(seen.normal_force) <= 1e-11);
  }
}

TEST_CASE("transmission_error: at constant gear speed the steady torque is the one that leaves no acceleration") {
  const double tau_l = 0.3, theta_g = 0.9;
  for (const double omega_w : {-300.0, 300.0}) {
    const auto idle = entered(table1(), constant(tau_l), constant(0.0), uneven);
    const double tau_m = steady_torque(idle, omega_w, theta_g, 0.0);
    const auto d = entered(table1(), constant(tau_l), constant(tau_m), uneven);
    const Motion motion = omega_w > 0.0 ? Motion::forward : Motion::backward;
    REQUIRE(std::abs(d.acceleration(d.moment(0.0, theta_g, omega_w / i), Mode{motion, Flank::left})) <= 1e-10);
  }
}

}  // namespace wormdrive::test::core_effects_kinematics
