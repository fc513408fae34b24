#include "core/elastic/compliant_drive.hpp"

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "compliant_drives.hpp"

// Friction, stick and events of the compliant drive.

namespace wormdrive::test::core_compliant_drive {

namespace {

constexpr double k = 1e6;  // [N/m]
const ToothContact<double> wide_gap{HuntCrossley<double>{k, 0.0}, 1.0};

/// The deflection [rad] at which a load torque rests on the left flank of a worm that the teeth hold alone.
double rest_deflection(const MeshParameters<double>& p, double tau_l, double stiffness, double backlash) {
  const GearMesh<double> mesh(p);
  const double Wn = tau_l * std::cos(p.lambda) / (std::cos(p.phi_n) * p.lg);
  return backlash / 2 + Wn / stiffness / mesh.gear_arm(0.0);
}

}  // namespace

TEST_CASE(
    "where worm and gear accelerate together, they do as in the rigid drive, whether or not the geometry closes") {
  for (const double mu : {0.02, 0.25, 1.0})
    for (const auto& p : {table1(mu), closing(table1(mu))})
      for (const auto& [tau_m, tau_l] : {std::pair{0.02, 0.3}, {0.5, 0.1}, {-0.3, -0.02}, {-0.1, 0.4}, {0.1, -0.2}}) {
        const auto rigid = entered(p, constant(tau_l), constant(tau_m));
        for (const double omega : {2.0, -2.0}) {
          const auto mode = rigid.settle({0.0, {0.3, omega}, {}});
          const auto seen = rigid.observe({0.0, {0.3, omega}, mode});
          auto elastic = compliant(p, constant(tau_l), constant(tau_m), {HuntCrossley<double>{k, 5.0}, 1e-3});
          elastic.enter(0.0);
          const double deflection = 0.5e-3 + seen.normal_force / k / elastic.mesh().gear_arm(0.0);
          const double theta_w = p.i * (0.3 - sign(mode.flank) * deflection);
          const typename decltype(elastic)::Instant now{0.0, {theta_w, p.i * omega, 0.3, omega}, {}};
          const auto settled = elastic.settle(now);
          REQUIRE(Mode(settled) == mode);
          const auto a = elastic.accelerations(elastic.moment(now), settled);
          REQUIRE(close(a.gear, seen.alpha_g, 1e-8));
          REQUIRE(close(a.worm, p.i * seen.alpha_g, 1e-8));
        }
      }
}

TEST_CASE("the Jacobian is the derivative's slope in every mode") {
  for (const ContactLaw<double>& law :
       {ContactLaw<double>(HuntCrossley<double>{k, 5.0}), ContactLaw<double>(LimitedDamper<double>{k, 30.0})}) {
    auto d = compliant(table1(), fig9_load(), fig9_motor(), {law, 1e-3},
                       effects(WormViscous<double>{1e-5}, GearCoulomb<double>{0.01}));
    d.enter(0.1);
    const Eigen::Vector4d x{0.06, 3.0, 0.004, 0.09}, scale{60.0, 60.0, 1.0, 1.0};
    for (const Flank contact : {Flank::left, Flank::none, Flank::right})
      for (const Motion worm : {Motion::backward, Motion::stuck, Motion::forward})
        for (const Motion gear : {Motion::stuck, Motion::forward}) {
          const CompliantMode mode{contact, worm, gear};
          const Eigen::Matrix4d J = d.jacobian(0.1, x, mode);
          for (int column = 0; column < 4; ++column) {
            const double h = 1e-7 * scale[column];
            Eigen::Vector4d up = x, down = x;
            up[column] += h;
            down[column] -= h;
            // the speed of a stuck shaft is zero and stays so
            if (column == 1 && worm == Motion::stuck) continue;
            if (column == 3 && gear == Motion::stuck) continue;
            const Eigen::Vector4d slope = (d.derivative(0.1, up, mode) - d.derivative(0.1, down, mode)) / (2 * h);
            REQUIRE((J.col(column) - slope).norm() <= 1e-5 * slope.norm() + 1e-9);
          }
        }
  }
}

TEST_CASE("teeth hold the worm of a self-locking gear up to the break-in torques, and a back-drivable one not at all") {
  const double tau_l = 0.2, rate = 1e-3;
  for (const double direction : {1.0, -1.0}) {
    const auto p = table1(0.25);
    const GearMesh<double> mesh(p);
    const double break_in = direction > 0 ? -mesh.C1() * tau_l : -mesh.C2() * tau_l;
    const auto d =
        compliant(p, constant(tau_l), Signal{{Ramp{.rate = direction * rate}}}, {HuntCrossley<double>{k, 100.0}, 1e-3});
    const double deflection = rest_deflection(p, tau_l, k, 1e-3);
    const auto r = run(d, Timetable(0, 20.0, 100.0), {0.0, {-p.i * deflection, 0.0, 0.0, 0.0}, {}}, tight(bdf, 1e-10));
    REQUIRE(r.rows.front().now.mode == CompliantMode{Flank::left, Motion::stuck, Motion::forward});
    REQUIRE_FALSE(r.events.empty());
    REQUIRE(r.events[0].after.mode.worm == (direction > 0 ? Motion::forward : Motion::backward));
    REQUIRE(close(direction * rate * r.events[0].after.t, break_in, 1e-6));
  }
  const auto p = table1(0.03);
  auto d = compliant(p, constant(tau_l), constant(0.0), {HuntCrossley<double>{k, 100.0}, 1e-3});
  d.enter(0.0);
  REQUIRE(d.settle({0.0, {-p.i * rest_deflection(p, tau_l, k, 1e-3), 0.0, 0.0, 0.0}, {}}).worm == Motion::forward);
}

TEST_CASE("at rest the teeth hold the worm as far as their friction goes, and its bearing holds the rest") {
  const auto p = table1();
  for (const double tau_m : {-0.01, 0.1, -0.1}) {
    auto d = compliant(p, constant(0.2), constant(tau_m), {HuntCrossley<double>{k, 0.0}, 0.0},
                       effects(WormCoulomb<double>{0.2}));
    d.enter(0.0);
    const typename decltype(d)::Instant now{0.0, {-p.i * rest_deflection(p, 0.2, k, 0.0), 0.0, 0.0, 0.0}, {}};
    const CompliantMode mode = d.settle(now);
    REQUIRE(mode.worm == Motion::stuck);
    const Observation seen = d.observe({now.t, now.x, mode});
    const double needed =
        (tau_m / p.lw + seen.normal_force * std::cos(p.phi_n) * std::sin(p.lambda)) / std::cos(p.lambda);
    REQUIRE(
        close(seen.teeth->friction, std::clamp(needed, -p.mu * seen.normal_force, p.mu * seen.normal_force), 1e-12));
    REQUIRE((std::abs(needed) < p.mu * seen.normal_force) == (tau_m == -0.01));
  }
}

TEST_CASE(
    "in the gap a bearing stops the worm and holds it, and another one holds the gear until its load breaks away") {
  const double T_w = 1e-3, T_g = 0.02, rate = 0.1;
  const auto p = table1();
  const auto r = run(compliant(p, Signal{{Ramp{.rate = rate}}}, constant(0.0), wide_gap,
                               effects(WormCoulomb<double>{T_w}, GearCoulomb<double>{T_g})),
                     Timetable(0, 0.25, 10.0), {0.0, {0.0, 2.0, 0.0, 0.0}, {}});
  REQUIRE(r.events.size() == 2);
  REQUIRE(r.events[0].after.mode == CompliantMode{Flank::none, Motion::stuck, Motion::stuck});
  REQUIRE(close(r.events[0].after.t, 2.0 * p.Jw / T_w, 1e-10));
  REQUIRE(r.events[1].after.mode == CompliantMode{Flank::none, Motion::stuck, Motion::forward});
  REQUIRE(close(r.events[1].after.t, T_g / rate, 1e-12));
  REQUIRE(r.end.x[1] == 0.0);
}

TEST_CASE("a worm at rest under a gear that flies freely starts at a short peak of the motor torque") {
  const double T_w = 1e-3, A = 1.001e-3, f = 5.0;
  const auto r = run(compliant(table1(), constant(0.0),
                               Signal{{Sinusoid{.amplitude = A, .frequency = f, .phase = -90 * unit::degree}}},
                               wide_gap, effects(WormCoulomb<double>{T_w})),
                     Timetable(0, 1.0, 10.0), {0.0, {0.0, 0.0, 0.0, 0.1}, {}});
  REQUIRE_FALSE(r.events.empty());
  REQUIRE(close(r.events[0].after.t, std::asin(T_w / A) / (2 * std::numbers::pi * f), 1e-9));
}

TEST_CASE("where eq. 17 is violated the teeth jam: they press exponentially and stop the worm, and the gear swings") {
  MeshParameters<double> p = table1(0.25);
  const double d0 = 1e-9;
  for (const double Jg : {0.02, 0.5}) {  // the limit is 0.0322 kg m^2
    p.Jg = Jg;
    const GearMesh<double> mesh(p);
    const double I1 = p.Jw * p.i + mesh.C1() * Jg;
    const double squared_rate = -k * mesh.gear_arm(0.0) * I1 * mesh.gear_arm(p.mu) / (p.i * p.Jw * Jg);
    const auto d = compliant(p, constant(0.0), constant(0.0), {HuntCrossley<double>{k, 0.0}, 0.0});
    const double lead = d0 / mesh.gear_arm(0.0), rate = std::sqrt(std::abs(squared_rate)), t = 1.0 / rate;
    const auto r = run(d, Timetable(0, 20 * t, t), {0.0, {-p.i * lead, 30.0, 0.0, 0.5}, {}});
    REQUIRE(r.rows.front().now.mode == CompliantMode{Flank::left, Motion::forward, Motion::forward});
    const auto after = std::find_if(r.rows.begin(), r.rows.end(), [&](const auto& row) { return row.now.t >= t; });
    const double grown = d.penetration(d.moment(after->now), Flank::left).first / d0;
    REQUIRE(close(grown, squared_rate > 0.0 ? std::cosh(1.0) : std::cos(1.0), 1e-4));
    const bool stopped = std::any_of(r.events.begin(), r.events.end(),
                                     [](const auto& event) { return event.after.mode.worm == Motion::stuck; });
    REQUIRE(stopped == (I1 < 0.0));
  }
}

}  // namespace wormdrive::test::core_compliant_drive
