#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "events/linear_motion.hpp"
#include "near_ties/dice.hpp"
#include "numbers.hpp"
#include "support.hpp"

// A motor whose amplifier controls the current, against closed forms: a lag of first order while the supply gives the
// voltage, the linear machine while it does not, piece by piece where the two take turns.

namespace wormdrive::test::events_current_loop {

namespace {

/// A servo motor of some 100 W on 24 V.
DcMotor<double> servo() {
  DcMotor<double> m;
  m.resistance = 0.8;
  m.torque_constant = 0.04;
  m.inductance = 6e-4;
  m.supply_voltage = 24.0;
  m.current_bandwidth = 400.0;
  return m;
}

/// Current and speed of a motor on one inertia with viscous friction, each piece of its motion by its exponential.
class Judge {
 public:
  Judge(const DcMotor<double>& m, double inertia, double friction)
      : m_(m), J_(inertia), b_(friction), omega_c_(2.0 * std::numbers::pi * *m.current_bandwidth) {}

  /// Speed [rad/s] and current [A] after a command was held [A] for a time [s].
  Eigen::Vector2d after(Eigen::Vector2d x, double command, double duration) {
    const double fastest = std::max({omega_c_, m_.resistance / *m_.inductance, b_ / J_});
    for (double left = duration; left > 0.0;) {
      const int side = side_of(x, command);
      // the regime holds to the first change that steps of a fiftieth of the fastest time show, and bisection finds
      const double step = std::min(left, 0.02 / fastest);
      double low = 0.0, high = step;
      while (high < left && side_of(moved(x, command, side, high), command) == side) {
        low = high;
        high = std::min(left, high + step);
      }
      if (side_of(moved(x, command, side, high), command) != side) {
        high = end_of(low, high, [&](double t) { return side_of(moved(x, command, side, t), command) == side; });
        ++changes;
      }
      x = moved(x, command, side, high);
      left -= high;
      if (high <= 0.0) break;
    }
    return x;
  }
  int changes = 0;

 private:
  /// -1 and 1 where the supply ends the voltage, 0 between.
  int side_of(const Eigen::Vector2d& x, double command) const {
    const double asked =
        m_.resistance * x[1] + m_.torque_constant * x[0] + *m_.inductance * omega_c_ * (command - x[1]);
    return asked > *m_.supply_voltage ? 1 : asked < -*m_.supply_voltage ? -1 : 0;
  }
  Eigen::Vector2d moved(const Eigen::Vector2d& x, double command, int side, double t) const {
    const double L = *m_.inductance, K = m_.torque_constant;
    Eigen::Matrix2d A;
    Eigen::Vector2d c;
    if (side == 0) {
      A << -b_ / J_, K / J_, 0.0, -omega_c_;
      c << 0.0, omega_c_ * command;
    } else {
      A << -b_ / J_, K / J_, -K / L, -m_.resistance / L;
      c << 0.0, side * *m_.supply_voltage / L;
    }
    return linear_motion(A, c, x, t);
  }

  DcMotor<double> m_;
  double J_, b_, omega_c_;
};

}  // namespace

TEST_CASE("a current loop brings the current to what is commanded as a lag of its bandwidth, moving and at rest") {
  const DcMotor<double> m = servo();
  const double omega_c = 2.0 * std::numbers::pi * *m.current_bandwidth, amps = 5.0;
  const MeshParameters<double> p = table1();
  for (const double tau_l : {-0.2, -4.0})
    for (const By by : every_solver) {
      const auto seen =
          run(drive_with_states(GearMesh<double>(p), constant(tau_l), constant(m.torque_constant * amps), effects(m)),
              Timetable(0, 0.01, 1e-4), {}, tight(by));
      REQUIRE((seen.end.x[1] != 0.0) == (tau_l == -0.2));
      for (const auto& row : seen.rows) {
        const double current = amps * -std::expm1(-omega_c * row.now.t);
        REQUIRE(std::abs(row.now.x[2] - current) <= 1e-10 * amps);
        const double voltage = m.resistance * current + m.torque_constant * p.i * row.now.x[1] +
                               *m.inductance * omega_c * (amps - current);
        REQUIRE(std::abs(row.seen.winding->voltage - voltage) <= 1e-8);
      }
    }
}

TEST_CASE("where the supply cannot give its voltage the current is that of the linear machine, drawn at random") {
  int changes = 0;
  for (int trial = 0; trial < 60; ++trial) {
    near_ties::Dice dice(20261127, static_cast<std::uint64_t>(trial));
    DcMotor<double> m;
    m.resistance = dice.decades(0.1, 10.0);
    m.torque_constant = dice.decades(0.01, 1.0);
    m.inductance = m.resistance * dice.decades(1e-4, 1e-2);
    m.supply_voltage = dice.decades(5.0, 400.0);
    m.current_bandwidth = dice.decades(0.3, 30.0) / (2.0 * std::numbers::pi) * m.resistance / *m.inductance;
    const double stall = *m.supply_voltage / m.resistance, idle = *m.supply_voltage / m.torque_constant,
                 electrical = *m.inductance / m.resistance,
                 // the mechanical time against the electrical one
        J = dice.decades(1.0, 100.0) * electrical * m.torque_constant * m.torque_constant / m.resistance,
                 b = dice.decades(1e-3, 0.3) * m.torque_constant * m.torque_constant / m.resistance;
    // a staircase of one step: one command, then another
    const double first = dice.sign() * dice.decades(0.3, 10.0) * stall,
                 second = dice.sign() * dice.decades(0.3, 10.0) * stall;
    const double held = dice.decades(2.0, 100.0) * electrical;
    const Signal command{
        {Constant{first * m.torque_constant},
         Staircase{.rise = (second - first) * m.torque_constant, .interval = held, .start = held, .steps = 1.0}}};
    Judge judge(m, J, b);
    const Eigen::Vector2d middle = judge.after({0.0, 0.0}, first, held), end = judge.after(middle, second, held);
    changes += judge.changes;
    for (const By by : every_solver) {
      INFO(trial << " by " << static_cast<int>(by.solver));
      const auto seen = run(
          drive_with_states(GearMesh<double>::without_teeth(J), Signal{}, command, effects(m, WormViscous<double>{b})),
          Timetable(0, 2.0 * held, held), {}, tight(by));
      const auto& half =
          *std::find_if(seen.rows.begin(), seen.rows.end(), [&](const auto& row) { return row.now.t == held; });
      for (const auto& [x, expected] : {std::pair{half.now.x, middle}, std::pair{seen.end.x, end}}) {
        CHECK(std::abs(x[1] - expected[0]) <= 1e-9 * idle);
        CHECK(std::abs(x[2] - expected[1]) <= 1e-9 * stall);
      }
      for (const auto& row : seen.rows) REQUIRE(std::abs(row.seen.winding->voltage) <= *m.supply_voltage);
    }
  }
  REQUIRE(changes > 30);
}

// The supply ends the voltage for a moment in every period, which a step that leaps over it does not see at its ends.
TEST_CASE("however short the supply is reached at the crest of a command, the current of a held gear shows it") {
  for (int trial = 0; trial < 40; ++trial) {
    near_ties::Dice dice(20261128, static_cast<std::uint64_t>(trial));
    DcMotor<double> m = servo();
    m.current_bandwidth = dice.decades(1.0, 1e3);
    const double omega_c = 2.0 * std::numbers::pi * *m.current_bandwidth, R = m.resistance, L = *m.inductance,
                 U = *m.supply_voltage, f = dice.decades(0.03, 3.0) * *m.current_bandwidth,
                 w = 2.0 * std::numbers::pi * f;
    // the voltage that a sinusoidal current asks for is |R + i w L| / |1 + i w/omega_c| of it
    const double excess = dice.decades(1e-4, 1.0),
                 A = (1.0 + excess) * U * std::hypot(1.0, w / omega_c) / std::hypot(R, w * L);
    const auto asked = [&](double t, double I) { return R * I + L * omega_c * (A * std::sin(w * t) - I); };
    const auto particular = [&](double t) {
      return A * omega_c * (omega_c * std::sin(w * t) - w * std::cos(w * t)) / (omega_c * omega_c + w * w);
    };
    const auto side = [&](double t, double I) { return asked(t, I) > U ? 1 : asked(t, I) < -U ? -1 : 0; };
    const double end = 3.0 / f, step = 1.0 / (5000.0 * std::max(f, omega_c));
    double from = 0.0, start = 0.0;  // of the present piece: its time and its current
    const auto moved = [&](int regime, double t) {
      if (regime == 0) return particular(t) + (start - particular(from)) * std::exp(-omega_c * (t - from));
      return regime * U / R + (start - regime * U / R) * std::exp(-R / L * (t - from));
    };
    int regime = 0, pieces = 0;
    for (double t = step; t < end; t += step) {
      if (side(t, moved(regime, t)) == regime) continue;
      const double change = end_of(t - step, t, [&](double x) { return side(x, moved(regime, x)) == regime; });
      start = moved(regime, change);
      regime = side(change, start);
      from = change;
      ++pieces;
    }
    REQUIRE(pieces >= 2);
    const double expected = moved(regime, end);
    for (const By by : every_solver) {
      INFO(trial << " by " << static_cast<int>(by.solver) << ", excess " << excess << ", " << pieces << " pieces");
      const Signal command{
          {Sinusoid{.amplitude = A * m.torque_constant, .frequency = f, .phase = -0.5 * std::numbers::pi}}};
      const auto seen = run(drive_with_states(GearMesh<double>(table1()), constant(-1e4), command, effects(m)),
                            Timetable(0, end, end), {}, tight(by, 1e-7));
      CHECK(std::abs(seen.end.x[2] - expected) <= 1e-5 * A);
    }
  }
}

TEST_CASE("a drive that controls its current gives its limit up to the speed at which the supply ends it") {
  DcMotor<double> m = servo();
  m.current_limit = 8.0;
  const double b = 2e-5, J = 1e-4, K = m.torque_constant;
  Effects<double> on = effects(m, WormViscous<double>{b});
  const auto seen = run(drive_with_states(GearMesh<double>::without_teeth(J), Signal{}, constant(1e3), on),
                        Timetable(0, 4, 1e-3), {}, tight(bdf));
  const double corner = (*m.supply_voltage - m.resistance * *m.current_limit) / K;
  int limited = 0, beyond = 0;
  for (const auto& row : seen.rows) {
    const Winding& winding = *row.seen.winding;
    if (row.now.t < 0.01) continue;  // 25 times the time of the loop
    if (row.now.x[1] < 0.99 * corner) {
      REQUIRE(std::abs(winding.current - *m.current_limit) <= 1e-9);
      ++limited;
    } else if (row.now.x[1] > 1.01 * corner) {
      REQUIRE(winding.voltage == *m.supply_voltage);
      ++beyond;
    }
  }
  REQUIRE(limited > 20);
  REQUIRE(beyond > 100);
  // in the end K I = b omega, U = R I + K omega
  REQUIRE(std::abs(seen.end.x[1] - *m.supply_voltage / (K + m.resistance * b / K)) <= 1e-9 * seen.end.x[1]);
}

// Under a constant voltage U0 the current of a held gear rises towards U0/R up to where the limiter takes over, and
// from there on towards the limit by the limiter's own time.
TEST_CASE("an amplifier that gives a voltage keeps the current of a held gear to its limit") {
  for (int trial = 0; trial < 40; ++trial) {
    near_ties::Dice dice(20261129, static_cast<std::uint64_t>(trial));
    DcMotor<double> m;
    const double R = m.resistance = dice.decades(0.1, 10.0), L = R * dice.decades(1e-5, 1e-2),
                 U0 = dice.decades(1.0, 400.0), limit = U0 / R * dice.between(0.1, 0.9),
                 rate = R / L * dice.decades(1.5, 100.0);
    m.torque_constant = dice.decades(0.01, 1.0);
    m.inductance = L;
    m.current_limit = limit;
    m.limiter_bandwidth = rate / (2.0 * std::numbers::pi);
    m.amplifier_gain = 1.0;
    m.supply_voltage = U0 * dice.between(1.0, 3.0);
    const double side = dice.sign();
    // it takes over where U0 = R I + L rate (limit - I)
    const double taken = (L * rate * limit - U0) / (L * rate - R);
    const double begins = taken > 0.0 ? -L / R * std::log1p(-taken * R / U0) : 0.0, from = std::max(taken, 0.0);
    const auto current = [&](double t) {
      return t <= begins ? -U0 / R * std::expm1(-R / L * t) : limit + (from - limit) * std::exp(-rate * (t - begins));
    };
    const double end = 3.0 * (begins + 1.0 / rate);
    for (const By by : every_solver) {
      INFO(trial << " by " << static_cast<int>(by.solver));
      const auto seen =
          run(drive_with_states(GearMesh<double>(table1()), constant(-1e6), constant(side * U0), effects(m)),
              Timetable(0, end, end / 20.0), {}, tight(by));
      REQUIRE(seen.events.empty());
      for (const auto& row : seen.rows) CHECK(std::abs(row.now.x[2] - side * current(row.now.t)) <= 1e-11 * limit);
    }
  }
}

TEST_CASE(
    "a limiter lets a short-circuited motor brake with its limit down to where the winding takes less by itself") {
  DcMotor<double> m = servo();
  m.current_bandwidth.reset();
  m.current_limit = 8.0;
  m.limiter_bandwidth = 400.0;
  m.amplifier_gain = 1.0;
  const double K = m.torque_constant, J = 1e-4, b = 2e-5, pull = K * *m.current_limit,
               corner = m.resistance * *m.current_limit / K;
  TimedDriveWithStates::Instant fast{};
  fast.x[1] = 500.0;
  for (const By by : every_solver) {
    const auto seen = run(drive_with_states(GearMesh<double>::without_teeth(J), Signal{}, constant(0.0),
                                            effects(m, WormViscous<double>{b})),
                          Timetable(0, 2.0, 1e-3), fast, tight(by));
    int limited = 0;
    for (std::size_t n = 20; n < seen.rows.size(); ++n) {  // 50 times the time of the limiter
      const auto &row = seen.rows[n], &before = seen.rows[n - 1];
      if (row.now.x[1] < 1.02 * corner) continue;
      CHECK(std::abs(row.now.x[2] + *m.current_limit) <= 1e-9);
      const double expected = (before.now.x[1] + pull / b) * std::exp(-b / J * 1e-3) - pull / b;
      CHECK(std::abs(row.now.x[1] - expected) <= 1e-8);
      CHECK(std::abs(row.seen.winding->voltage - (K * row.now.x[1] - m.resistance * *m.current_limit)) <= 1e-6);
      ++limited;
    }
    CHECK(limited > 50);
    CHECK(seen.rows.back().seen.winding->voltage == 0.0);
    CHECK(std::abs(seen.end.x[1]) <= 1.0);
  }
}

}  // namespace wormdrive::test::events_current_loop
