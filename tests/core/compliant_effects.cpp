#include <cmath>

#include "catch.hpp"
#include "compliant_drives.hpp"

// Effects act on the compliant drive as on the rigid one.

namespace wormdrive::test::core_compliant_effects {

namespace {

constexpr double k = 1e6;  // [N/m]

/// Every effect that changes the motion, one at a time.
std::vector<Effects<double>> each_effect() {
  const CubicTable hill({-1.0, 0.0, 0.4, 1.0}, {0.0, 0.1, 0.3, 0.2});
  return {effects(TorqueGain<double>{0.2}),
          effects(TorqueOffset<double>{0.03}),
          effects(Cogging<double>{0.02, 3.0, 0.4}),
          effects(WormCoulomb<double>{0.01}),
          effects(DcMotor<double>{1.2, 0.025}),
          effects(WormLuGre<double>{0.01, 0.02, 30.0}),
          effects(WormViscous<double>{2e-4}),
          effects(WormCoulomb<double>{0.01}, WormViscous<double>{2e-4}, BearingAsymmetry<double>{0.005, 1e-4}),
          effects(HoldingBrake<double>{0.01}),
          effects(WormInertia<double>{1e-5}),
          effects(MeshFriction<double>{-0.05}),
          effects(Stribeck<double>{0.1, 0.5}),
          effects(FrictionAsymmetry<double>{0.04}),
          effects(PositionFriction<double>{0.3, 0.2}),
          effects(FrictionDrift<double>{0.5, 2.0}),
          effects(FrictionMap<double>{FrictionAxis::gear_angle, FrictionValue::share, 1.0, hill}),
          effects(LoadMap<double>{LoadAxis::time, 1.0, hill}),
          effects(Vibration<double>{0.02, 3.0, 0.4}),
          effects(GearboxHeat<double>{0.01, 1e-4, 0.02, {}, {}, 30.0}),
          effects(GearCoulomb<double>{0.01}),
          effects(GearViscous<double>{0.01}),
          effects(FrictionUnderLoad<double>{0.2}),
          effects(GearInertia<double>{2e-4}),
          effects(LoadMagnitude<double>{0.3}),
          effects(LoadAngle<double>{0.5}),
          effects(LoadSpring<double>{0.1, -0.4}),
          effects(LoadCoupling<double>{2e-4}),
          effects(LoadCrank<double>{0.2, 0.03, 0.07, 0.4}),
          effects(LoadFourBar<double>{1e-4, 0.03, 0.07, 0.06, 0.08, 0.4})};
}

}  // namespace

TEST_CASE("where worm and gear accelerate together, every effect does to them what it does to the rigid drive") {
  GravityArm arm;
  arm.amplitude = 0.3;
  const double t = 0.3, theta_g = 0.3;
  int changed = 0;
  for (const Effects<double>& on : each_effect())
    for (const double omega : {2.0, -2.0}) {
      const auto rigid = entered(table1(), arm, constant(0.02), on, t), plain = entered(table1(), arm, constant(0.02));
      auto elastic = compliant(table1(), arm, constant(0.02), {HuntCrossley<double>{k, 5.0}, 1e-3}, on);
      elastic.enter(t);
      const Mode mode = rigid.settle({t, {theta_g, omega}, {}});
      // the worm angle, on which cogging depends, is found along with the force that deflects the teeth
      Moment<double> at = rigid.moment(t, theta_g, omega);
      double alpha = 0.0;
      for (int round = 0; round < 5; ++round) {
        alpha = rigid.acceleration(at, mode);
        const double m = mode.product() * rigid.friction(at, mode.motion);
        const double force = sign(mode.flank) * (rigid.side_torques(at, mode.motion).gear - rigid.Jg(at) * alpha) /
                             rigid.mesh().gear_arm(m);
        const double deflection = sign(mode.flank) * (0.5e-3 + force / k / rigid.mesh().gear_arm(0.0));
        at.theta_w = 60.0 * (theta_g - deflection);
      }
      const typename decltype(elastic)::Instant now{t, {at.theta_w, at.omega_w, theta_g, omega}, {}};
      const CompliantMode settled = elastic.settle(now);
      REQUIRE(settled.contact == mode.flank);
      REQUIRE(settled.worm == mode.motion);
      const auto a = elastic.accelerations(elastic.moment(now), settled);
      REQUIRE(close(a.gear, alpha, 1e-8));
      REQUIRE(close(a.worm, 60.0 * alpha, 1e-8));
      const Mode without = plain.settle({t, {theta_g, omega}, {}});
      changed += !close(plain.acceleration(plain.moment(t, theta_g, omega), without), alpha, 1e-4);
      const Observation seen = elastic.observe({t, now.x, settled});
      REQUIRE(seen.tau_m == rigid.inputs(at, mode.motion).worm);
      REQUIRE(seen.tau_l == rigid.inputs(at, mode.motion).gear);
    }
  REQUIRE(changed == 2 * static_cast<int>(each_effect().size()));
}

TEST_CASE("a worm at rest is held between the frictions of its two directions") {
  // the worm breaks away where the friction of that direction is overcome, not the other one's
  const double tau_l = 0.2, rate = 1e-3, mu = 0.25, change = 0.1;
  for (const double direction : {1.0, -1.0}) {
    const auto p = table1(mu);
    const GearMesh<double> own(table1(mu + direction * change));
    const double break_in = direction > 0 ? -own.C1() * tau_l : -own.C2() * tau_l;
    const auto d = compliant(p, constant(tau_l), Signal{{Ramp{.rate = direction * rate}}},
                             {HuntCrossley<double>{k, 100.0}, 1e-3}, effects(FrictionAsymmetry<double>{change}));
    const GearMesh<double> mesh(p);
    const double Wn = tau_l * std::cos(p.lambda) / (std::cos(p.phi_n) * p.lg);
    const double deflection = 0.5e-3 + Wn / k / mesh.gear_arm(0.0);
    const auto r = run(d, Timetable(0, 30.0, 100.0), {0.0, {-p.i * deflection, 0.0, 0.0, 0.0}, {}}, tight(bdf, 1e-10));
    REQUIRE(r.rows.front().now.mode.worm == Motion::stuck);
    REQUIRE_FALSE(r.events.empty());
    REQUIRE(r.events[0].after.mode.worm == (direction > 0 ? Motion::forward : Motion::backward));
    REQUIRE(close(direction * rate * r.events[0].after.t, break_in, 1e-6));
  }
}

TEST_CASE("where a bearing holds the rest, teeth hold the worm as far as the friction of the direction goes") {
  const auto p = table1();
  for (const double direction : {1.0, -1.0}) {
    auto d = compliant(p, constant(0.2), constant(0.1 * direction), {HuntCrossley<double>{k, 0.0}, 0.0},
                       effects(WormCoulomb<double>{0.2}, FrictionAsymmetry<double>{0.1}));
    d.enter(0.0);
    const double deflection = 0.2 / k / std::pow(d.mesh().gear_arm(0.0), 2);
    const typename decltype(d)::Instant now{0.0, {-p.i * deflection, 0.0, 0.0, 0.0}, {}};
    const Observation seen = d.observe({now.t, now.x, d.settle(now)});
    REQUIRE(seen.mode.motion == Motion::stuck);
    REQUIRE(close(seen.teeth->friction, direction * (p.mu + 0.1 * direction) * seen.normal_force, 1e-12));
  }
}

TEST_CASE("a worm whose bearing is only thicker one way follows its direction, and an effect alone makes teeth rub") {
  auto p = table1(0.0);
  auto d = compliant(p, constant(0.0), constant(0.0), {HuntCrossley<double>{k, 0.0}, 1.0},
                     effects(WormViscous<double>{1e-4}, BearingAsymmetry<double>{0.0, 5e-5}));
  d.enter(0.0);
  for (const double omega : {3.0, -3.0}) {
    const typename decltype(d)::Instant now{0.0, {0.0, omega, 0.0, 0.0}, {}};
    const auto a = d.accelerations(d.moment(now), d.settle(now));
    REQUIRE(close(a.worm, -(omega > 0 ? 1.5e-4 : 0.5e-4) * omega / p.Jw, 1e-12));
  }
  auto rubbed = compliant(p, constant(0.2), constant(0.0), {HuntCrossley<double>{k, 0.0}, 0.0},
                          effects(MeshFriction<double>{0.25}));
  rubbed.enter(0.0);
  REQUIRE(rubbed.settle({0.0, {-60.0 * 1e-4, 0.0, 0.0, 0.0}, {}}).worm == Motion::stuck);
}

TEST_CASE("the sensor shows the gear's angle with the encoder's errors") {
  const auto d = compliant(table1(), constant(0.0), constant(0.0), {HuntCrossley<double>{k, 0.0}, 1.0},
                           effects(EncoderScale<double>{0.1}, EncoderOffset<double>{0.02}));
  const double shown = d.rigid().effects().measured_angle(0.3);
  REQUIRE(shown != 0.3);
  REQUIRE(d.measured_angle({0.0, {7.0, 0.0, 0.3, 0.0}, {}}) == shown);
}

}  // namespace wormdrive::test::core_compliant_effects
