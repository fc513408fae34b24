#include <cmath>

#include "catch.hpp"
#include "support.hpp"

// What happens to a command on its way to the motor: delay and lag, each alone against a closed form, and together with
// a limit against an integration of the lag's own equation.

namespace wormdrive::test::core_effects_command {

namespace {

constexpr double J = 2.0;

/// A flywheel of 2 kg m^2 without a gear.
auto flywheel(const Signal& motor, const Effects<double>& on) {
  return WormDrive<double, TimedLoad>(GearMesh<double>::without_teeth(J), make_load(constant(0.0)), on, motor);
}
template <class System>
Run<System> a_second(const System& system, By by) {
  return run(system, Timetable(0, 1, 0.01), {}, tight(by));
}

/// Torques 0.1, 0.2, 0.3, ... at successive samples.
struct Counting {
  double torque = 0.0;
  template <class System>
  double sample(const System&, const typename System::Instant&) {
    return torque += 0.1;
  }
};

Signal wavy() {
  return {{Sinusoid{.amplitude = 0.6, .frequency = 1.3, .phase = 0.4}, Step{.torque = 0.5, .time = 0.31},
           Ramp{.rate = -0.7, .start = 0.5, .end = 0.8}}};
}

}  // namespace

TEST_CASE("actuator_lag: after a step the torque comes as 1 - exp(-t/time), and 63 % of it within the time constant") {
  const double lag = 0.2;
  for (const By by : every_solver) {
    const auto result = a_second(flywheel(constant(0.4), effects(ActuatorLag<double>{lag})), by);
    for (const auto& row : result.rows)
      REQUIRE(std::abs(row.seen.tau_m - 0.4 * (1.0 - std::exp(-row.now.t / lag))) <= 1e-15);
    REQUIRE(close(result.end.x[1], 0.4 / J * (1.0 - lag * (1.0 - std::exp(-1.0 / lag))), 1e-11));
  }
}

TEST_CASE("actuator_lag: through knots and limits the torque obeys lag y' + y = u") {
  const double lag = 0.05, h = 1e-5;
  const Signal u = wavy();
  const auto cut = [&](double t) { return std::clamp(u.piece(t)(t), -0.7, 0.7); };
  const auto result = a_second(flywheel(u, effects(TorqueSaturation<double>{0.7}, ActuatorLag<double>{lag})), taylor);
  double y = 0.0;
  long k = 0;
  for (const auto& row : result.rows) {
    for (; (k + 1) * h <= row.now.t + 1e-9; ++k) {  // the trapezoidal rule, to second order but at the knots
      const double a = (cut(k * h) - y) / lag, b = (cut((k + 1) * h - 1e-12) - y - h * a) / lag;
      y += 0.5 * h * (a + b);
    }
    if (std::abs(row.now.t - k * h) < 1e-9) REQUIRE(std::abs(row.seen.tau_m - y) <= 1e-8);
  }
  REQUIRE(k >= 99'000);
}

TEST_CASE(
    "actuator_lag: a sampled torque follows its samples, be the lag a hundredth of a sample or a hundred of them") {
  constexpr double h = 0.01;
  for (const double lag : {1e-4, 7e-4, 3e-3, 1e-2, 4e-2, 1.0})
    for (const double start : {3.0, 1e-3, 0.0})
      for (const By by : every_solver) {
        INFO("lag " << lag << " s, from " << start << " rad/s, solver " << static_cast<int>(by.solver));
        Counting controller;
        const auto result =
            run(flywheel({}, effects(ActuatorLag<double>{lag})), Timetable(0, 1, 0.017, {.period = h, .offset = 0.0}),
                {0.0, {0.0, start}, {}}, tight(by, 1e-12), controller);
        // An error of taylor is one of a second, an error of cvode one of each of thousands of steps.
        const double error = by.solver == SolverKind::taylor ? 1e-11 : 3e-9;
        double theta = 0.0, omega = start, torque = 0.0;
        std::size_t row = 0;
        for (int k = 0; k < 100; ++k) {  // tau = u - left e^(-s/lag)
          const double u = 0.1 * (k + 1), left = u - torque;
          const auto arrived = [&](double s) { return -std::expm1(-s / lag); };
          const auto speed = [&](double s) { return omega + (u * s - left * lag * arrived(s)) / J; };
          const auto angle = [&](double s) {
            return theta + omega * s + (0.5 * u * s * s - left * lag * (s - lag * arrived(s))) / J;
          };
          for (; row < result.rows.size() && result.rows[row].now.t <= (k + 1) * h; ++row) {
            const double s = result.rows[row].now.t - k * h;
            CHECK(std::abs(result.rows[row].now.x[1] - speed(s)) <= error * (1.0 + speed(s)));
            CHECK(std::abs(result.rows[row].now.x[0] - angle(s)) <= error * (1.0 + angle(s)));
          }
          const double next = angle(h);
          omega = speed(h);
          theta = next;
          torque = u - left * std::exp(-h / lag);
        }
        CHECK(row == result.rows.size());
      }
}

TEST_CASE("actuator_delay: the torque is the command of earlier, and nothing before the first has come") {
  const double late = 0.123;
  const Signal u = wavy();
  for (const By by : every_solver) {
    const auto result = a_second(flywheel(u, effects(ActuatorDelay<double>{late})), by);
    for (const auto& row : result.rows) {
      const double then = row.now.t - late;
      if (std::abs(then) < 1e-9 || std::abs(then - 0.31) < 1e-9) continue;  // both sides of a jump are rows
      REQUIRE(std::abs(row.seen.tau_m - (then < 0.0 ? 0.0 : u.piece(then)(then))) <= 1e-14);
    }
  }
  for (const By by : every_solver) {
    const auto end = a_second(flywheel(constant(0.4), effects(ActuatorDelay<double>{0.25})), by).end;
    REQUIRE(close(end.x[1], 0.4 * 0.75 / J, 1e-13));
    REQUIRE(close(end.x[0], 0.5 * 0.4 * 0.75 * 0.75 / J, 1e-12));
  }
}

TEST_CASE("actuator_delay: a sampled torque arrives the delay after its sample, several samples later if need be") {
  const double late = 0.23;
  for (const By by : every_solver) {
    Counting controller;
    const auto result = run(flywheel({}, effects(ActuatorDelay<double>{late})),
                            Timetable(0, 1, 0.017, {.period = 0.1, .offset = 0.0}), {}, tight(by), controller);
    double impulse = 0.0;
    for (int k = 0; k < 8; ++k) impulse += 0.1 * (k + 1) * std::min(0.1, 1.0 - late - 0.1 * k);
    REQUIRE(close(result.end.x[1], impulse / J, 1e-12));
  }
}

TEST_CASE("a lag behind a delay starts when the first command has come") {
  const double late = 0.1, lag = 0.2;
  for (const By by : every_solver) {
    const auto result =
        a_second(flywheel(constant(0.4), effects(ActuatorDelay<double>{late}, ActuatorLag<double>{lag})), by);
    for (const auto& row : result.rows) {
      const double since = std::max(0.0, row.now.t - late);
      REQUIRE(std::abs(row.seen.tau_m - 0.4 * (1.0 - std::exp(-since / lag))) <= 1e-14);
    }
  }
}

TEST_CASE("a lag of a thousandth of the motion's time changes fig. 9 by about that, one of nothing by nothing") {
  const auto end = [](const Effects<double>& on) {
    return run(drive(table1(), fig9_load(), fig9_motor(), on), Timetable(0, 1, 0.1), {}).end.x;
  };
  const auto bare = end({}), lagged = end(effects(ActuatorLag<double>{1e-4})),
             half = end(effects(ActuatorLag<double>{5e-5}));
  REQUIRE(std::abs(lagged[0] - bare[0]) >= 1e-5);
  REQUIRE(std::abs((half[0] - bare[0]) / (lagged[0] - bare[0]) - 0.5) <= 0.01);
  const auto delayed = end(effects(ActuatorDelay<double>{1e-4}));
  REQUIRE(std::abs((delayed[0] - bare[0]) / (lagged[0] - bare[0]) - 1.0) <= 0.01);  // to first order a lag is a delay
}

TEST_CASE("actuator_lag: a drive at rest is watched closely only until the torque has settled") {
  auto d = entered(table1(), constant(0.5), constant(0.01), effects(ActuatorLag<double>{1e-6}));
  REQUIRE(d.fastest_input(0.0) == 1e6);
  REQUIRE(d.fastest_input(1e-4) == 0.0);
  for (const By by : every_solver)
    REQUIRE(run(d, Timetable(0, 1e4, 5e3), {}, tight(by)).end.mode.motion == Motion::stuck);
}

}  // namespace wormdrive::test::core_effects_command
