#include "core/elastic/compliant_start.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "catch.hpp"
#include "compliant_drives.hpp"

// The state from which elastic teeth begin: decided by the load, not by what rounding leaves of a torque.

namespace wormdrive::test::core_compliant_start {

namespace {

constexpr double quarter = std::numbers::pi / 2;
const ToothContact<double> teeth{HuntCrossley<double>{1e6, 20.0}, 1e-3};

Signal wave(double amplitude, double phase, double frequency = 5.0) {
  return {{Sinusoid{.amplitude = amplitude, .frequency = frequency, .phase = phase}}};
}

/// By how much the gear is ahead of the worm at the start [rad].
template <class Load>
double deflection(const Load& load, const Signal& motor, double theta_g = 0.0, Effects<double> on = {}) {
  auto d = compliant(table1(), load, motor, teeth, std::move(on));
  d.enter(0.0);
  const auto x = carrying(d, 0.0, theta_g, 0.0);
  return (60.0 * x[2] - x[0]) / 60.0;
}

struct RandomDrive {
  MeshParameters<double> mesh;
  ToothContact<double> contact;
  Effects<double> on;
  double tau_m, tau_l, theta_g;

  explicit RandomDrive(std::mt19937_64& random) {
    const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    mesh = table1(std::pow(10.0, between(-2.5, 1.5)));  // back-drivable to a worm that locks itself
    const double k = std::pow(10.0, between(4.0, 8.0));
    contact = {between(0.0, 1.0) < 0.5 ? ContactLaw<double>(HuntCrossley<double>{k, between(0.0, 100.0)})
                                       : ContactLaw<double>(LimitedDamper<double>{k, between(0.0, 1e3)}),
               between(0.0, 1.0) < 0.2 ? 0.0 : between(1e-5, 1e-2)};
    if (between(0.0, 1.0) < 0.3) on = effects(WormCoulomb<double>{between(0.0, 0.02)});
    tau_l = between(-1.0, 1.0);
    // half of them about the torques that just hold the load
    const GearMesh<double> gear(mesh);
    const double held = between(0.0, 1.0) < 0.5 ? -gear.C1() * tau_l : -gear.C2() * tau_l;
    tau_m = between(0.0, 1.0) < 0.5 ? held * between(0.9, 1.1) : between(-0.2, 0.2);
    theta_g = between(-3.0, 3.0);
  }
  auto begun(double more_motor, double more_load) const {
    auto d = compliant(mesh, constant(tau_l + more_load), constant(tau_m + more_motor), contact, on);
    d.enter(0.0);
    typename decltype(d)::Instant now{0.0, carrying(d, 0.0, theta_g, 0.0), {}};
    now.mode = d.settle(now);
    return std::pair(std::move(d), now);
  }
};

}  // namespace

TEST_CASE("teeth start in the middle of their gap where no load acts, whatever the motor does") {
  for (const double tau_m : {0.0, 1e-18, -1e-18, 1e-6, 0.3, -0.3})
    REQUIRE(deflection(constant(0.0), constant(tau_m)) == 0.0);
  for (const int quarters : {-5, -3, -1, 1, 3, 5, 401}) {
    REQUIRE(deflection(constant(0.0), wave(0.05, quarters * quarter)) == 0.0);
    REQUIRE(deflection(wave(0.2, quarters * quarter), constant(0.01)) == 0.0);
  }
}

TEST_CASE("what rounding leaves of a load is none: of an upright arm, of terms that cancel, of a spring at its angle") {
  GravityArm arm = fig9_load();
  for (const int quarters : {-7, -3, -1, 1, 3, 201}) {
    REQUIRE(deflection(arm, constant(0.0), quarters * quarter) == 0.0);
    REQUIRE(deflection(arm, constant(0.0), quarters * quarter - 0.1, effects(LoadAngle<double>{0.1})) == 0.0);
    arm.offset = 0.4;
    REQUIRE(deflection(arm, constant(0.0), quarters * quarter - 0.4) == 0.0);
    arm.offset = 0.0;
  }
  REQUIRE(0.1 + 0.2 - 0.3 != 0.0);
  REQUIRE(deflection(Signal{{Constant{0.1}, Constant{0.2}, Constant{-0.3}}}, constant(0.0)) == 0.0);
  REQUIRE(deflection(Signal{{Sinusoid{0.3, 1.0, std::numbers::pi / 3}, Constant{-0.15}}}, constant(0.0)) == 0.0);
  REQUIRE(deflection(constant(0.0), constant(0.0), 0.1 + 0.2,
                     effects(LoadSpring<double>{.stiffness = 2.0, .rest = 0.3})) == 0.0);
  // and beside a motor torque a load of its rounding is none
  REQUIRE(deflection(constant(1e-18), constant(0.05)) == 0.0);
}

TEST_CASE("a load that acts is carried on its flank, however small it is") {
  for (const double tau_l : {1e-9, 1e-3, 1.0}) {
    const double left = deflection(constant(tau_l), constant(0.0)), right = deflection(constant(-tau_l), constant(0.0));
    REQUIRE(left > 0.5e-3 * (1.0 - 1e-12));
    REQUIRE(close(right, -left, 1e-12));
  }
}

TEST_CASE("elastic teeth make the same events whichever way rounding leaves the first torque") {
  std::vector<std::size_t> counts;
  for (const double phase : {-quarter, 3.0 * quarter, -5.0 * quarter, 7.0 * quarter}) {
    auto d =
        compliant(table1(), constant(0.0), wave(0.05, phase), {HuntCrossley<double>{1e6, 20.0}, 0.1 * unit::degree});
    d.enter(0.0);
    const auto r = run(d, Timetable(0, 0.5, 0.01), {0.0, carrying(d, 0.0, 0.0, 0.0), {}});
    counts.push_back(r.events.size());
  }
  CAPTURE(counts);
  REQUIRE(counts.front() > 20);
  REQUIRE(std::count(counts.begin(), counts.end(), counts.front()) == 4);
}

TEST_CASE(
    "random drives begin in balance: no blow at the gear, no force that friction cannot hold, no jump of a force") {
  std::mt19937_64 random(19);
  int held = 0, slides = 0;
  for (int n = 0; n < 2000; ++n) {
    const RandomDrive one(random);
    const auto [d, now] = one.begun(0.0, 0.0);
    const auto at = d.moment(now);
    const double Wn = d.normal_force(at, now.mode), Wf = d.friction(at, now.mode, Wn);
    INFO("drive " << n << ", mu " << one.mesh.mu << ", tau_m " << one.tau_m << ", tau_l " << one.tau_l << ", Wn "
                  << Wn);
    const double rounding = 1e-16 * one.mesh.i * (std::abs(one.theta_g) + 1.0) * d.contact().stiffness();  // of Wn [N]
    REQUIRE(now.mode.contact == (one.tau_l > 0.0 ? Flank::left : Flank::right));
    REQUIRE(std::abs(Wf) <= one.mesh.mu * Wn * (1.0 + 1e-12));
    const double arm = (1.0 + one.mesh.mu) * one.mesh.lg;
    CHECK(std::abs(d.accelerations(at, now.mode).gear) * d.rigid().Jg() <= 1e-9 * std::abs(one.tau_l) + arm * rounding);
    (now.mode.worm == Motion::stuck ? held : slides) += 1;
    // what holds the worm up to the start is what rubs on it from there on
    auto before = now.mode;
    before.worm = Motion::stuck;
    CHECK(std::abs(d.friction(at, before, Wn) - Wf) <=
          1e-9 * (std::abs(Wf) + std::abs(one.tau_m) / one.mesh.lw) + arm * rounding);
  }
  CHECK(held > 300);
  CHECK(slides > 300);
}

TEST_CASE("the start of random drives moves no further than its inputs do") {
  std::mt19937_64 random(20);
  for (int n = 0; n < 2000; ++n) {
    const RandomDrive one(random);
    const auto start = one.begun(0.0, 0.0).second;
    for (const double more : {1e-18, -1e-18, 1e-12, -1e-12}) {
      const auto motor = one.begun(more, 0.0).second, load = one.begun(0.0, more).second;
      // a torque as an angle of the worm, through teeth that nothing but friction makes stiffer
      const double angle = 1e3 * std::abs(more) / (one.mesh.lw * one.mesh.lg * 1e4) + 1e-14;
      INFO("drive " << n << ", mu " << one.mesh.mu << ", tau_m " << one.tau_m << ", tau_l " << one.tau_l);
      REQUIRE(std::abs(motor.x[0] - start.x[0]) <= angle);
      REQUIRE(std::abs(load.x[0] - start.x[0]) <= angle);
      if (std::abs(more) > 1e-17) continue;
      REQUIRE(motor.mode == start.mode);
      REQUIRE(load.mode == start.mode);
    }
  }
}

}  // namespace wormdrive::test::core_compliant_start
