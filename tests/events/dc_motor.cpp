#include <cmath>
#include <optional>

#include "catch.hpp"
#include "events/linear_motion.hpp"
#include "events/torque_ratio.hpp"
#include "support.hpp"

// A motor with a winding against closed forms: the linear machine, its torque-speed line, the rise of the current at
// rest and the break-away that it brings.

namespace wormdrive::test::events_dc_motor {

namespace {

/// A motor of some 30 W on its amplifier of 1 V per N m: commands are voltages.
DcMotor<double> motor(double inductance) {
  DcMotor<double> m;
  m.resistance = 1.2;
  m.torque_constant = 0.025;
  m.inductance = inductance;
  m.amplifier_gain = 1.0;
  return m;
}

}  // namespace

TEST_CASE("speed and current of a motor on one inertia are those of the linear machine to 1e-9") {
  const double J = 2e-4, b = 1e-5, U = 12.0;
  const double L = 1.5e-3;
  const DcMotor<double> m = motor(L);
  const Effects<double> on = effects(m, WormViscous<double>{b});
  const auto machine = drive_with_states(GearMesh<double>::without_teeth(J), Signal{}, constant(U), on);
  const double R = m.resistance, K = m.torque_constant;
  Eigen::Matrix2d A;
  A << -b / J, K / J, -K / L, -R / L;
  for (const By by : every_solver) {
    const auto seen = run(machine, Timetable(0, 1, 0.01), {}, tight(by));
    REQUIRE(seen.rows.size() > 100);
    for (const auto& row : seen.rows) {
      const Eigen::Vector2d x = linear_motion(A, {0.0, U / L}, {0.0, 0.0}, row.now.t);
      REQUIRE(std::abs(row.now.x[1] - x[0]) <= 1e-9 * U / K);
      REQUIRE(std::abs(row.now.x[2] - x[1]) <= 1e-9 * U / R);
      REQUIRE(row.seen.winding->current == row.now.x[2]);
      REQUIRE(row.seen.tau_m == K * row.now.x[2]);
    }
  }
}

TEST_CASE("so they are behind a gear with friction while it moves in one direction") {
  const MeshParameters<double> p = table1();
  const double U = 9.0, tau_l = -0.4, b = 1e-6, L = 1.5e-3;
  const DcMotor<double> m = motor(L);
  const auto machine =
      drive_with_states(GearMesh<double>(p), constant(tau_l), constant(U), effects(m, WormViscous<double>{b}));
  const double R = m.resistance, K = m.torque_constant;
  typename decltype(machine)::Instant start;
  start.x.head<3>() << 0.0, 1.0, 5.0;
  for (const By by : every_solver) {
    const auto seen = run(machine, Timetable(0, 0.5, 0.005), start, tight(by));
    const Mode mode = seen.rows.back().now.mode;
    REQUIRE(seen.events.empty());
    REQUIRE(mode.motion == Motion::forward);
    const double C = torque_ratio(p, mode.product() * p.mu), M = p.Jw * p.i + C * p.Jg;
    Eigen::Matrix2d A;
    A << -b * p.i / M, K / M, -K * p.i / L, -R / L;
    const Eigen::Vector2d c{C * tau_l / M, U / L};
    for (const auto& row : seen.rows) {
      const Eigen::Vector2d x = linear_motion(A, c, {1.0, 5.0}, row.now.t);
      REQUIRE(std::abs(row.now.x[1] - x[0]) <= 1e-9 * U / (K * p.i));
      REQUIRE(std::abs(row.now.x[2] - x[1]) <= 1e-9 * U / R);
    }
  }
}

TEST_CASE("a winding without inductance gives the torque-speed line, by every solver") {
  const MeshParameters<double> p = table1();
  for (const By by : every_solver)
    for (const double U : {-12.0, -3.0, 6.0, 12.0}) {
      const DcMotor<double> m = motor(0.0);
      const auto seen =
          run(drive(p, fig9_load(), constant(U), effects(m)), Timetable(0, 0.5, 0.01), {}, tight(by, 1e-12));
      REQUIRE(std::abs(seen.end.x[1]) > 0.5 * std::abs(U) / (m.torque_constant * p.i));
      for (const auto& row : seen.rows) {
        const double omega_w = p.i * row.now.x[1], current = (U - m.torque_constant * omega_w) / m.resistance;
        REQUIRE(std::abs(row.seen.tau_m - m.torque_constant * current) <= 1e-12);
        REQUIRE(std::abs(row.seen.winding->current - current) <= 1e-12);
        REQUIRE(row.seen.winding->voltage == U);
      }
    }
}

TEST_CASE("an inductance that falls leads to the motor without one, in proportion") {
  const MeshParameters<double> p = table1();
  const auto end_with = [&](double L) {
    const auto machine = drive_with_states(GearMesh<double>(p), fig9_load(), constant(12.0), effects(motor(L)));
    return run(machine, Timetable(0, 0.2, 0.2), {}, tight(bdf)).end.x[0];
  };
  const double without =
      run(drive(p, fig9_load(), constant(12.0), effects(motor(0.0))), Timetable(0, 0.2, 0.2), {}, tight(bdf)).end.x[0];
  const double far = end_with(2e-4) - without, near = end_with(1e-4) - without;
  REQUIRE(far < 0.0);
  REQUIRE(std::abs(far / near - 2.0) <= 0.04);
}

TEST_CASE("at rest the current rises by itself, and the gear breaks away when its torque is reached, also just so") {
  const MeshParameters<double> p = table1();
  const double tau_l = -0.5, L = 1.5e-3;
  const DcMotor<double> m = motor(L);
  const double R = m.resistance, K = m.torque_constant, tau = L / R;
  const double needed = -torque_ratio(p, -p.mu) * tau_l / K;  // A
  REQUIRE(needed > 0.1);
  for (const By by : every_solver)
    for (const double excess : {1.0, 1e-3, 1e-6, 1e-9}) {
      const double U = R * needed * (1.0 + excess);
      const auto seen = run(drive_with_states(GearMesh<double>(p), constant(tau_l), constant(U), effects(m)),
                            Timetable(0, 0.1, 1e-3), {}, tight(by));
      REQUIRE_FALSE(seen.events.empty());
      const auto& away = seen.events.front();
      REQUIRE(away.before.mode == Mode{});
      REQUIRE(away.after.mode == Mode{Motion::forward, Flank::right});
      const double expected = tau * std::log((1.0 + excess) / excess);
      // what the current errs by, over how fast it approaches what is needed
      REQUIRE(std::abs(away.before.t - expected) <= tau * 1e-11 * (1.0 + 1.0 / excess));
      for (const auto& row : seen.rows)
        if (row.now.t < away.before.t)
          REQUIRE(std::abs(row.now.x[2] - U / R * (1.0 - std::exp(-row.now.t / tau))) <= 1e-11 * U / R);
    }
  const auto held =
      run(drive_with_states(GearMesh<double>(p), constant(tau_l), constant(R * needed * (1.0 - 1e-9)), effects(m)),
          Timetable(0, 1.0, 0.1), {}, tight(bdf));
  REQUIRE(held.events.empty());
}

TEST_CASE("a gear that is held stays at speed zero to the last bit while the current follows a command with knots") {
  DcMotor<double> m = motor(1.27e-5);  // back-EMF per inductance is great against 1: a solver that pivots mixes rows
  m.supply_voltage = 3.0;
  const Signal volts{{Sinusoid{.amplitude = 8.0, .frequency = 0.8}}};
  for (const By by : every_solver) {
    const auto seen = run(drive_with_states(GearMesh<double>(table1()), constant(-2.0), volts, effects(m)),
                          Timetable(0, 1, 0.01), {}, tight(by, 1e-12));
    REQUIRE(seen.events.empty());
    for (const auto& row : seen.rows) REQUIRE(row.now.x[1] == 0.0);
  }
}

TEST_CASE(
    "a winding that is held warms up as a capacity behind a thermal resistance does, while its current rises too") {
  const double U = 6.0;
  for (const double L : {0.0, 1.5e-3, 0.3})
    for (const double H : {0.02, 40.0}) {
      DcMotor<double> m = motor(L);
      m.heat_capacity = H;
      m.thermal_resistance = 5.0;
      const double T = 5.0 * H, heat = U * U / m.resistance;
      // the answer of the capacity to heat that decays at a rate
      const auto answer = [&](double rate, double t) {
        return (std::exp(-rate * t) - std::exp(-t / T)) / (1.0 / T - rate) / H;
      };
      for (const By by : every_solver) {
        // steps of a millisecond for ten minutes, but for BDF
        if (L > 0.0 && m.resistance / L * T > 1e4 && !(by.solver == SolverKind::cvode && by.method == Method::bdf))
          continue;
        const auto seen = run(drive_with_states(GearMesh<double>(table1()), constant(-2.0), constant(U), effects(m)),
                              Timetable(0, 3.0 * T, T / 20), {}, tight(by));
        for (const auto& row : seen.rows) {
          const double t = row.now.t, rate = L > 0.0 ? m.resistance / L : 0.0;
          double h = heat * answer(0.0, t);
          if (L > 0.0) h += heat * (answer(2.0 * rate, t) - 2.0 * answer(rate, t));
          REQUIRE(std::abs(row.now.x[3] - h) <= 1e-9 * heat * 5.0);
          REQUIRE(row.seen.winding->warmth == row.now.x[3]);
        }
      }
    }
}

TEST_CASE("a winding of copper takes less current the warmer it is, until it gives off what it takes") {
  const double U = 6.0, cold = 1.2, alpha = 0.0039, thermal = 5.0;
  for (const double L : {0.0, 1.5e-3}) {
    DcMotor<double> m = motor(L);
    m.heat_capacity = 0.4;
    m.thermal_resistance = thermal;
    m.temperature_coefficient = alpha;
    const auto seen = run(drive_with_states(GearMesh<double>(table1()), constant(-2.0), constant(U), effects(m)),
                          Timetable(0, 100, 1), {}, tight(bdf));
    // alpha h^2 + h = thermal U^2/cold
    const double h = (std::sqrt(1.0 + 4.0 * alpha * thermal * U * U / cold) - 1.0) / (2.0 * alpha);
    const Winding& end = *seen.rows.back().seen.winding;
    REQUIRE(h > 80.0);
    REQUIRE(std::abs(end.warmth - h) <= 1e-9 * h);
    REQUIRE(std::abs(end.current - U / (cold * (1.0 + alpha * h))) <= 1e-9 * U / cold);
    REQUIRE(std::abs(end.loss - h / thermal) <= 1e-9 * end.loss);
    REQUIRE(std::abs(seen.rows.back().seen.tau_m - m.torque_constant * end.current) <= 1e-15);
  }
}

}  // namespace wormdrive::test::events_dc_motor
