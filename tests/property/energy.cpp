#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "catch.hpp"
#include "support.hpp"

// Energy is only accounted for by a geometry that closes, i = lg/(lw tan lambda): there the normal force does no work.

namespace wormdrive::test::property_energy {

namespace {

/// What the drive receives and what friction takes [W], from the observed forces alone.
struct Powers {
  double motor = 0.0, load = 0.0, friction = 0.0;

  Powers operator+(const Powers& b) const { return {motor + b.motor, load + b.load, friction + b.friction}; }
  Powers operator*(double s) const { return {s * motor, s * load, s * friction}; }
};

template <class Drive>
Powers powers(const Drive& d, const typename Drive::Instant& now) {
  const Observation seen = d.observe(now);
  const auto at = d.moment(now);
  const double bearings = d.effects().worm_torque(at, now.mode.motion) * at.omega_w +
                          d.effects().gear_torque(seen.tau_l, at, now.mode.motion) * at.omega_g;
  const double sliding = std::abs(d.mesh().sliding_speed(at.omega_w));
  return {seen.tau_m * at.omega_w, seen.tau_l * at.omega_g, d.mesh().mu * seen.normal_force * sliding - bearings};
}

/// Kinetic energy of both bodies over the gear speed's square.
template <class Drive>
double half_inertia(const Drive& d) {
  return 0.5 * (d.mesh().Jw * d.mesh().i * d.mesh().i + d.Jg());
}

/// Works over a segment without mode change, by the classical Runge-Kutta method on state and powers together.
template <class Drive>
Powers works(const Drive& d, typename Drive::Instant now, double end) {
  const int steps = 1000;
  const double h = (end - now.t) / steps, begin = now.t;
  const auto at = [&](double t, const typename Drive::State& x) { return typename Drive::Instant{t, x, now.mode}; };
  const auto rate = [&](const typename Drive::Instant& i) { return d.derivative(i.t, i.x, i.mode); };
  Powers sum;
  for (int k = 0; k < steps; ++k) {
    now.t = begin + k * h;
    const auto k1 = rate(now);
    const auto second = at(now.t + h / 2, now.x + h / 2 * k1);
    const auto k2 = rate(second);
    const auto third = at(now.t + h / 2, now.x + h / 2 * k2);
    const auto k3 = rate(third);
    const auto fourth = at(now.t + h, now.x + h * k3);
    const auto k4 = rate(fourth);
    sum = sum + (powers(d, now) + powers(d, second) * 2 + powers(d, third) * 2 + powers(d, fourth)) * (h / 6);
    now.x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return sum;
}

struct Balance {
  double work = 0.0;      ///< motor and load together, each segment by its size [J]
  double friction = 0.0;  ///< [J]
  double load = 0.0;      ///< [J], signed
  double missing = 0.0;   ///< what does not add up [J]
  long segments = 0;
};

template <class Drive>
Balance balance(const Drive& d, const Run<Drive>& of) {
  Balance sum;
  auto begin = of.rows.front().now;
  const auto close = [&](const typename Drive::Instant& end) {
    const Powers done = works(d, begin, end.t);
    const double gained = half_inertia(d) * (end.x[1] * end.x[1] - begin.x[1] * begin.x[1]);
    sum.work += std::abs(done.motor) + std::abs(done.load);
    sum.friction += done.friction;
    sum.load += done.load;
    sum.missing += done.motor + done.load - done.friction - gained;
    ++sum.segments;
  };
  for (const auto& event : of.events) {
    close(event.before);
    begin = event.after;
  }
  close(of.end);
  return sum;
}

Effects<double> bearings() {
  return effects(WormCoulomb<double>{0.003}, WormViscous<double>{2e-5}, GearCoulomb<double>{0.004},
                 GearViscous<double>{0.002}, FrictionUnderLoad<double>{0.1});
}

}  // namespace

TEST_CASE("the work of motor and constant load is friction loss and kinetic energy and nothing else") {
  for (const Effects<double>& on : {Effects<double>{}, bearings()}) {
    const auto d = entered(closing(table1()), constant(0.02), fig9_motor(), on);
    const Balance sum = balance(d, run(d, Timetable(0, 2, 0.1), {}));
    REQUIRE(sum.segments >= 6);
    REQUIRE(sum.friction > 0.01 * sum.work);
    REQUIRE(std::abs(sum.missing) <= 1e-9 * sum.work);
  }
}

TEST_CASE("the work of motor and gravity is friction loss and kinetic energy and nothing else") {
  for (const Effects<double>& on : {Effects<double>{}, bearings()}) {
    GravityArm arm = fig9_load();
    arm.own_inertia = 0.002;
    const auto d = entered(closing(table1()), arm, fig9_motor(), on);
    const auto result = run(d, Timetable(0, 2, 0.1), {0.0, {0.3, 0.5}, {}});
    const Balance sum = balance(d, result);
    REQUIRE(sum.segments >= 6);
    REQUIRE(sum.friction > 0.01 * sum.work);
    REQUIRE(std::abs(sum.missing) <= 1e-9 * sum.work);
    // the load is conservative: its work is the height it fell, whatever happened on the way
    const double fell = 0.0196 * (std::sin(result.end.x[0]) - std::sin(0.3));
    REQUIRE(std::abs(sum.load - fell) <= 1e-9 * sum.work);
  }
}

TEST_CASE("the printed Table 1 does not close, and without friction its mesh makes energy of nothing") {
  const auto account = [](const MeshParameters<double>& p) {
    const auto d = entered(p, constant(0.02), fig9_motor());
    const Balance sum = balance(d, run(d, Timetable(0, 1, 0.1), {}));
    return std::abs(sum.missing) / sum.work;
  };
  REQUIRE(account(closing(table1(0.0))) <= 1e-9);
  REQUIRE(account(table1(0.0)) >= 1e-4);
}

TEST_CASE("friction never creates energy, not in any row of 100 random drives") {
  std::mt19937 random(2009);
  std::uniform_real_distribution<double> unit_interval(0.0, 1.0);
  const auto between = [&](double low, double high) { return low + (high - low) * unit_interval(random); };
  std::map<int, int> rows_by_mode;
  Deviation explained;
  double most_created = 0.0;
  for (int drives = 0; drives < 100;) {
    MeshParameters<double> p = table1();
    p.lambda = between(0.03, 0.7);
    p.phi_n = between(0.1, 0.5);
    p.i = between(10.0, 80.0);
    p.lg = p.i * p.lw * std::tan(p.lambda);
    p.Jg = between(1e-4, 5e-3);
    p.mu = between(0.0, 0.9) * std::min(0.6, GearMesh<double>(p).mu_g());
    if (GearMesh<double>(p).C1() * p.Jg <= -p.Jw * p.i) continue;  // eq. 17: would jam
    ++drives;

    GravityArm arm;
    arm.amplitude = between(-0.3, 0.3);
    arm.offset = between(-3.0, 3.0);
    const Signal motor{
        {Constant{between(-0.02, 0.02)}, Sinusoid{.amplitude = between(0.0, 0.1), .frequency = between(0.5, 4.0)}}};
    const auto d = entered(p, arm, motor, drives % 2 == 0 ? bearings() : Effects<double>{});
    const auto result = run(d, Timetable(0, 0.5, 0.005), {0.0, {0.0, between(-1.0, 1.0)}, {}}, tight(adams, 1e-8));
    for (const auto& row : result.rows) {
      // the last row before a reversal may be past it by the 100 ulp of time within which CVODE places an event
      const double past = std::abs(row.seen.alpha_g) * 100.0 * std::numeric_limits<double>::epsilon() * 0.5;
      if (row.now.mode.motion != Motion::stuck && std::abs(row.seen.omega_g) <= past) continue;
      ++rows_by_mode[row.now.mode.product()];
      // what motor and load put in and the bodies do not keep; computed without Wn, mu or bearings
      const Powers power = powers(d, row.now);
      const double kept = 2.0 * half_inertia(d) * row.seen.alpha_g * row.seen.omega_g;
      const double scale = std::abs(power.motor) + std::abs(power.load) + std::abs(kept) + 1e-300;
      const double lost = power.motor + power.load - kept;
      most_created = std::max(most_created, -lost / scale);
      explained.add((lost - power.friction) / scale);
      most_created = std::max(most_created, -power.friction / scale);
    }
  }
  REQUIRE((rows_by_mode[-1] > 1000 && rows_by_mode[0] > 100 && rows_by_mode[1] > 1000));
  REQUIRE(most_created <= 1e-12);
  REQUIRE(explained <= 1e-12);
}

}  // namespace wormdrive::test::property_energy
