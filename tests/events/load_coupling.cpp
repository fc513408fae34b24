#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include "catch.hpp"
#include "core/loads/gravity_arm.hpp"
#include "core/states/starting_state.hpp"
#include "events/four_modes.hpp"
#include "events/runge_kutta.hpp"
#include "events/torque_ratio.hpp"
#include "near_ties/dice.hpp"
#include "numbers.hpp"
#include "support.hpp"

// A load behind a coupling that twists, against closed forms and against a judge that goes from mode to mode by matrix
// exponentials and shares no code with the program.

namespace wormdrive::test::events_load_coupling {

namespace {

using Coupling = LoadCoupling<double>;

Coupling coupling(double inertia, double stiffness, std::optional<double> damping = {}) {
  return {inertia, stiffness, damping};
}
constexpr int twist_at = 2 + int{StateLayout<EffectList<double>>::first<Coupling>()}, speed_at = twist_at + 1;

template <class Drive>
typename Drive::Instant started(Drive drive, const InitialState<double>& initial) {
  drive.enter(0.0);
  typename Drive::Instant now;
  now.x = starting_state(drive, initial, 0.0);
  return now;
}

/// A drive whose load hangs behind a coupling, under a torque level + amplitude cos(omega t + phase) and a constant
/// load.
struct Case {
  MeshParameters<double> p;
  double level, amplitude, omega, phase, tau_l, inertia, stiffness, damping;

  Signal motor() const { return {{Constant{level}, Sinusoid{amplitude, omega / (2.0 * std::numbers::pi), phase}}}; }
  auto drive() const {
    return drive_with_states(GearMesh<double>(p), constant(tau_l), motor(),
                             effects(coupling(inertia, stiffness, damping)));
  }
};

/// e^A by its series, of a matrix that is halved until its norm is below 1/2, and squared as often.
using Matrix = Eigen::Matrix<double, 7, 7>;
Matrix exponential(const Matrix& A) {
  int halvings = 0;
  std::frexp(2.0 * A.norm(), &halvings);
  halvings = std::max(0, halvings);
  const Matrix small = A / std::exp2(halvings);
  Matrix term = Matrix::Identity(), sum = term;
  for (double k = 1.0; k <= 16.0; ++k) {  // 0.5^17 / 17! is below the rounding of 1
    term = term * small / k;
    sum += term;
  }
  for (int k = 0; k < halvings; ++k) sum = (sum * sum).eval();
  return sum;
}

/// Its motion: gear angle and speed, twist, speed of the load, cosine and sine of the motor's torque, and 1.
class Judge {
 public:
  using State = Eigen::Matrix<double, 7, 1>;
  struct Event {
    double t;
    Mode before, after;
  };

 private:
  auto accelerations(const State& x) const {
    return [this, &x](Mode in) { return acceleration(x, in); };
  }

 public:
  Judge(const Case& c, double duration) : c_(c) {
    y << 0.0, 0.0, c.tau_l / c.stiffness, 0.0, c.amplitude * std::cos(c.phase), c.amplitude * std::sin(c.phase), 1.0;
    mode = mode_from_rest(beyond(y), accelerations(y));
    const double fastest = std::max(c.omega, std::sqrt(c.stiffness * (1.0 / c.inertia + 1.0 / c.p.Jg)));
    const double step = std::min(0.01 / fastest, duration);
    std::map<int, Matrix> of_a_step;
    for (double t = 0.0; t < duration;) {
      const double h = std::min(step, duration - t);
      const int key = sign(mode.motion) * 2 + sign(mode.flank);
      if (!of_a_step.contains(key)) of_a_step[key] = exponential(rates(mode) * step);
      const State then = h == step ? State(of_a_step[key] * y) : moved(h);
      if (holds(then)) {
        y = then;
        t += h;
        continue;
      }
      const double until = end_of(0.0, h, [&](double s) { return holds(moved(s)); });
      y = moved(until);
      t += until;
      const Mode before = mode;
      mode = mode_behind(mode, y[1], beyond(y), accelerations(y));
      events.push_back({t, before, mode});
      if (events.size() > 200) return;
    }
  }

  std::vector<Event> events;
  State y;
  Mode mode;

 private:
  double tau_m(const State& x) const { return c_.level + x[4]; }
  double tau_g(const State& x) const { return c_.stiffness * x[2] + c_.damping * (x[3] - x[1]); }
  double beyond(const State& x) const { return tau_m(x) - c_.p.Jw * c_.p.i / c_.p.Jg * tau_g(x); }
  double acceleration(const State& x, Mode in) const {
    const double C = torque_ratio(c_.p, in.product() * c_.p.mu);
    return (tau_m(x) + C * tau_g(x)) / (c_.p.Jw * c_.p.i + C * c_.p.Jg);
  }
  bool holds(const State& x) const { return mode_holds(mode, x[1], beyond(x), accelerations(x)); }
  Matrix rates(Mode in) const {
    const double k = c_.stiffness, d = c_.damping, w = c_.omega;
    Matrix A = Matrix::Zero();
    if (in.motion != Motion::stuck) {
      const double C = torque_ratio(c_.p, in.product() * c_.p.mu), M = c_.p.Jw * c_.p.i + C * c_.p.Jg;
      A(0, 1) = 1.0;
      A.row(1) << 0.0, -C * d / M, C * k / M, C * d / M, 1.0 / M, 0.0, c_.level / M;
    }
    A(2, 1) = -1.0;
    A(2, 3) = 1.0;
    A.row(3) << 0.0, d / c_.inertia, -k / c_.inertia, -d / c_.inertia, 0.0, 0.0, c_.tau_l / c_.inertia;
    A(4, 5) = -w;
    A(5, 4) = w;
    return A;
  }
  State moved(double t) const { return exponential(rates(mode) * t) * y; }

  Case c_;
};

Case drawn(near_ties::Dice& dice) {
  Case c{};
  c.p = table1(dice.between(0.05, 0.4));
  const double natural = dice.decades(3.0, 3e3);
  c.inertia = c.p.Jg * dice.decades(0.03, 30.0);
  c.stiffness = c.inertia * natural * natural;
  c.damping = 2.0 * dice.decades(1e-3, 0.5) * c.inertia * natural;
  c.tau_l = dice.sign() * dice.decades(0.01, 10.0);
  const double break_in = torque_ratio(c.p, -c.p.mu) * std::abs(c.tau_l);
  c.level = break_in * dice.between(-0.5, 0.5);
  c.amplitude = break_in * dice.decades(0.5, 20.0);
  c.omega = natural * dice.decades(0.1, 5.0);
  c.phase = dice.between(-3.0, 3.0);
  return c;
}

}  // namespace

TEST_CASE("two inertias on a coupling swing against each other as the closed form says, and keep momentum and energy") {
  for (int trial = 0; trial < 20; ++trial) {
    near_ties::Dice dice(20261201, static_cast<std::uint64_t>(trial));
    const double J1 = dice.decades(1e-4, 1e2), J2 = J1 * dice.decades(0.01, 100.0), omega = dice.decades(0.1, 1e4),
                 k = omega * omega * J1 * J2 / (J1 + J2), speed = dice.sign() * omega * dice.decades(0.1, 10.0);
    // struck at the gear only: it turns, and the load does not yet
    const double end = 7.3 / omega, mean = J1 * speed / (J1 + J2);
    for (const By by : every_solver) {
      INFO(trial << " by " << static_cast<int>(by.solver));
      const auto d =
          drive_with_states(GearMesh<double>::without_teeth(J1), Signal{}, Signal{}, effects(coupling(J2, k)));
      auto start = started(d, {.theta_g = 0.2, .omega_g = speed});
      REQUIRE(start.x[speed_at] == speed);
      start.x[speed_at] = 0.0;
      const auto seen = run(d, Timetable(0, end, end / 10.0), start, tight(by));
      Deviation x, v, momentum, energy;
      for (const auto& row : seen.rows) {
        const auto& now = row.now;
        x.add((now.x[twist_at] + speed / omega * std::sin(omega * now.t)) * omega / speed);
        v.add((now.x[speed_at] - mean * (1.0 - std::cos(omega * now.t))) / speed);
        momentum.add((J1 * now.x[1] + J2 * now.x[speed_at]) / (J1 * speed) - 1.0);
        energy.add((J1 * now.x[1] * now.x[1] + J2 * now.x[speed_at] * now.x[speed_at] +
                    k * now.x[twist_at] * now.x[twist_at]) /
                       (J1 * speed * speed) -
                   1.0);
      }
      const bool damps = by.solver == SolverKind::cvode && by.method == Method::bdf;  // a little, as BDF does
      CHECK(x <= 1e-10);
      CHECK(v <= 1e-10);
      CHECK(momentum <= 1e-10);
      CHECK(energy <= (damps ? 1e-9 : 1e-10));
    }
  }
}

TEST_CASE("a gear that holds lets its load swing, until the coupling pulls it away at the time of the closed form") {
  // The gear holds at zero motor torque, whatever the load; the motor helps the load, and its swing decides when.
  const MeshParameters<double> p = table1();
  const double J2 = 0.02, k = 800.0, omega = std::sqrt(k / J2), tau_l = 1.0;
  const double C = torque_ratio(p, p.mu);  // negative: forward at tau_m > -C tau_g
  const double tau_m = -C * 1.6 * tau_l;   // holds up to a load of 0.8 of what the swing reaches ... backward is held
  for (const By by : every_solver) {
    const auto d = drive_with_states(GearMesh<double>(p), constant(tau_l), constant(tau_m), effects(coupling(J2, k)));
    auto start = started(d, {});
    start.x[twist_at] = 1.9 * tau_l / k;  // let go from here: tau_g = tau_l (1 + 0.9 cos omega t)
    const auto seen = run(d, Timetable(0, 0.1, 0.001), start, tight(by));
    REQUIRE(seen.rows.front().now.mode.motion == Motion::stuck);
    REQUIRE(!seen.events.empty());
    const double expected = std::acos(0.6 / 0.9) / omega;
    CHECK(std::abs(seen.events.front().before.t - expected) <= 1e-11);
    CHECK(seen.events.front().after.mode.motion == Motion::forward);
  }
}

TEST_CASE("a run starts with the load in balance on its coupling") {
  GravityArm arm;
  arm.mass = 2.0;
  arm.arm = 0.3;
  arm.offset = 0.4;
  for (const double k : {3.0, 40.0, 1e4})  // the softest gives way by radians
    for (const By by : every_solver) {
      INFO(k);
      const auto d = drive_with_states(GearMesh<double>(table1()), arm, constant(0.0), effects(coupling(0.01, k)));
      const auto start = started(d, {.theta_g = 0.3});
      const double x = start.x[twist_at];
      REQUIRE(std::abs(k * x - 2.0 * gravity * 0.3 * std::cos(0.3 + x + 0.4)) <= 1e-13 * gravity);
      const auto seen = run(d, Timetable(0, 1, 0.1), start, tight(by));
      CHECK(seen.events.empty());
      CHECK(std::abs(seen.end.x[twist_at] - x) <= 1e-12);
      CHECK(seen.end.x[1] == 0.0);
    }
}

TEST_CASE("of many twists that carry an arm on a soft coupling a run starts with the least") {
  for (int trial = 0; trial < 60; ++trial) {
    near_ties::Dice dice(20261208, static_cast<std::uint64_t>(trial));
    GravityArm arm;
    arm.amplitude = 1.0;
    arm.offset = dice.between(-3.0, 3.0);
    const double k = dice.decades(1e-4, 10.0), torque = std::cos(arm.offset);
    const auto start =
        started(drive_with_states(GearMesh<double>(table1()), arm, constant(0.0), effects(coupling(0.01, k))), {});
    // walked out from where it is relaxed, in steps of a thousandth of a radian
    const double way = torque > 0.0 ? 1e-3 : -1e-3;
    double x = 0.0;
    while ((std::cos(arm.offset + x) - k * x > 0.0) == (torque > 0.0)) x += way;
    INFO(trial << ", k = " << k);
    CHECK(std::abs(start.x[twist_at] - x) <= 1.01e-3);
  }
}

TEST_CASE("the inertia of the load turns behind the coupling with what is there") {
  GravityArm arm;
  arm.mass = 2.0;
  arm.arm = 0.3;
  const double J2 = 0.01 + 2.0 * 0.3 * 0.3, k = 50.0;
  const auto d = drive_with_states(GearMesh<double>(table1()), arm, constant(0.0), effects(coupling(0.01, k)));
  REQUIRE(d.Jg() == table1().Jg);
  auto now = started(d, {});
  now.x[twist_at] = 0.2;
  now.x[speed_at] = 0.7;
  const auto rate = d.derivative(0.0, now.x, Mode{});
  CHECK(rate[twist_at] == 0.7);
  CHECK(close(rate[speed_at], (2.0 * gravity * 0.3 * std::cos(0.2) - k * 0.2) / J2, 1e-14));
  // without a stiffness it is the gear's
  REQUIRE(close(drive(table1(), arm, constant(0.0), effects(Coupling{0.01})).Jg(), table1().Jg + J2, 1e-15));
}

TEST_CASE("drives whose load swings behind a coupling have the events and the end of an independent judge") {
  int events = 0, compared = 0;
  for (int trial = 0; trial < 40; ++trial) {
    near_ties::Dice dice(20261202, static_cast<std::uint64_t>(trial));
    const Case c = drawn(dice);
    const double natural = std::sqrt(c.stiffness / c.inertia),
                 end = 2.0 * std::numbers::pi * dice.between(1.0, 4.0) / std::min(natural, c.omega);
    const Judge judge(c, end);
    for (const By by : every_solver) {
      INFO(trial << " by " << static_cast<int>(by.solver) << static_cast<int>(by.method));
      const auto d = c.drive();
      const auto seen = run(d, Timetable(0, end, end / 10.0), started(d, {}), tight(by));
      REQUIRE(seen.events.size() == judge.events.size());
      Deviation late;
      for (std::size_t k = 0; k < judge.events.size(); ++k) {
        CHECK(seen.events[k].after.mode == judge.events[k].after);
        late.add((seen.events[k].after.t - judge.events[k].t) / end);
      }
      CHECK(late <= 1e-9);
      const double fast = std::max(1e-3, std::abs(judge.y[1]) + std::abs(judge.y[3]));
      CHECK(std::abs(seen.end.x[1] - judge.y[1]) <= 1e-8 * fast);
      CHECK(std::abs(seen.end.x[speed_at] - judge.y[3]) <= 1e-8 * fast);
      CHECK(std::abs(seen.end.x[0] - judge.y[0]) <= 1e-8 * std::max(fast / natural, std::abs(judge.y[0])));
      ++compared;
    }
    events += static_cast<int>(judge.events.size());
  }
  REQUIRE(compared == 120);
  REQUIRE(events > 300);
}

// Its torque is another law in either direction, and that of a load is no mode of the drive. At the start the load is
// at rest, in balance with an arm, and what is left of that balance is rounding.
TEST_CASE("a fan behind a coupling brakes the load whichever way it turns, from rest on") {
  int reversals = 0;
  for (int trial = 0; trial < 12; ++trial) {
    near_ties::Dice dice(20261205, static_cast<std::uint64_t>(trial));
    const double J1 = dice.decades(1e-4, 1.0), J2 = J1 * dice.decades(0.1, 10.0), natural = dice.decades(1.0, 1e3),
                 k = natural * natural * J1 * J2 / (J1 + J2), omega = natural * dice.decades(0.2, 2.0),
                 amplitude = (J1 + J2) * omega * omega * dice.decades(0.1, 10.0),
                 drag = J2 * dice.decades(0.03, 3.0),  // [kg m^2]: over the square of the speed
        weight = J2 * omega * omega * dice.decades(0.1, 10.0);
    Fan fan;
    fan.rated_torque = drag;
    fan.rated_speed = 1.0;
    GravityArm arm;
    arm.amplitude = weight;
    const Signal motor{{Sinusoid{amplitude, omega / (2.0 * std::numbers::pi), -0.5 * std::numbers::pi}}};
    const auto d =
        drive_with_states(GearMesh<double>::without_teeth(J1), LoadSum{{fan, arm}}, motor, effects(coupling(J2, k)));
    const auto start = started(d, {});
    // fixed steps of Runge and Kutta
    using State = Eigen::Vector4d;
    const auto rates = [&](double t, const State& x) -> State {
      const double twisting = k * x[2], load = weight * std::cos(x[0] + x[2]) - drag * x[3] * std::abs(x[3]);
      return {x[1], (amplitude * std::sin(omega * t) + twisting) / J1, x[3] - x[1], (load - twisting) / J2};
    };
    const double end = 20.0 / omega, h = end / 40000.0;
    State x(0.0, 0.0, start.x[twist_at], 0.0);
    for (int n = 0; n < 40000; ++n) {
      const State then = runge_kutta(rates, n * h, x, h);
      reversals += x[3] * then[3] < 0.0;
      x = then;
    }
    for (const By by : every_solver) {
      INFO(trial << " by " << static_cast<int>(by.solver) << static_cast<int>(by.method));
      const auto seen = run(d, Timetable(0, end, end), start, tight(by));
      const double fast = std::abs(x[1]) + std::abs(x[3]) + natural * std::abs(x[2]);
      CHECK(std::abs(seen.end.x[1] - x[1]) <= 1e-8 * fast);
      CHECK(std::abs(seen.end.x[speed_at] - x[3]) <= 1e-8 * fast);
      CHECK(std::abs(seen.end.x[twist_at] - x[2]) * natural <= 1e-8 * fast);
    }
  }
  REQUIRE(reversals > 30);
}

TEST_CASE("a load that a fan brakes starts in balance behind a worm as well") {
  for (int trial = 0; trial < 20; ++trial) {
    near_ties::Dice dice(20261206, static_cast<std::uint64_t>(trial));
    const double J2 = 7e-4 * dice.decades(0.1, 100.0), natural = dice.decades(3.0, 300.0);
    Fan fan;
    fan.rated_torque = J2 * dice.decades(1e-3, 1.0);
    fan.rated_speed = 1.0;
    GravityArm arm;
    arm.amplitude = dice.decades(0.01, 1.0);
    const auto d = drive_with_states(GearMesh<double>(table1()), LoadSum{{fan, arm}}, constant(dice.sign() * 0.3),
                                     effects(coupling(J2, J2 * natural * natural, 0.05 * J2 * natural)));
    std::vector<Mode> expected;
    for (const By by : every_solver) {
      INFO(trial << " by " << static_cast<int>(by.solver) << static_cast<int>(by.method));
      const auto seen = run(d, Timetable(0, 10.0 / natural, 1.0 / natural), started(d, {}), tight(by));
      if (expected.empty()) expected = seen.modes();
      CHECK(seen.modes() == expected);
    }
  }
}

TEST_CASE("a coupling that hardly twists is the rigid one, to the first order of its softness") {
  const MeshParameters<double> p = table1(0.15);
  const double J2 = 2e-3, tau_l = 0.2;
  const Signal motor{{Sinusoid{.amplitude = 0.06, .frequency = 2.0, .phase = -0.5 * std::numbers::pi}}};
  const auto rigid = run(drive(p, constant(tau_l), motor, effects(Coupling{J2})), Timetable(0, 0.8, 0.1), {}, tight());
  REQUIRE(rigid.events.size() >= 3);
  std::vector<double> apart;
  for (const double natural : {1e3, 1e4}) {
    // the damping lets the shock of a flank change die away
    const auto d = drive_with_states(GearMesh<double>(p), constant(tau_l), motor,
                                     effects(coupling(J2, J2 * natural * natural, 2.0 * J2 * natural)));
    const auto seen = run(d, Timetable(0, 0.8, 0.1), started(d, {}), tight(bdf, 1e-11));
    apart.push_back(std::abs(seen.end.x[0] - rigid.end.x[0]));
  }
  CHECK(apart[1] <= 1e-4 * std::abs(rigid.end.x[0]));
  CHECK(apart[0] / apart[1] >= 5.0);
}

}  // namespace wormdrive::test::events_load_coupling
