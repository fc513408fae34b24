#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "core/energy.hpp"
#include "core/steady.hpp"
#include "support.hpp"

// Effects of actuator, shafts, load and sensor, each alone against a closed form that fixes its sign, unit and size.

namespace wormdrive::test::core_effects_torques {

namespace {

constexpr double J = 2.0;

/// A flywheel of 2 kg m^2 without a gear: worm and gear are one.
template <class Load>
auto flywheel(const Load& load, double torque, const Effects<double>& on) {
  using Made = decltype(make_load(load));
  return WormDrive<double, Made>(GearMesh<double>::without_teeth(J), make_load(load), on, constant(torque));
}

template <class System>
typename System::Instant after_a_second(const System& system, By by, double theta, double omega) {
  return run(system, Timetable(0, 1, 0.25), {0.0, {theta, omega}, {}}, tight(by)).end;
}

/// Angle after a second from rest under a constant torque: half the acceleration.
double turned(const Effects<double>& on, By by, double torque) {
  return after_a_second(flywheel(constant(0.0), torque, on), by, 0.0, 0.0).x[0];
}

/// A closed, frictionless gear: all that acts on it is the effect.
MeshParameters<double> smooth() { return closing(table1(0.0)); }

}  // namespace

TEST_CASE("torque_gain: the motor gives 1 + share of its command, and a quarter more turns a quarter further") {
  for (const By by : every_solver) {
    REQUIRE(close(turned(effects(TorqueGain<double>{0.25}), by, 0.4), 0.5 * 0.4 * 1.25 / J, 1e-11));
    REQUIRE(close(turned(effects(TorqueGain<double>{-0.25}), by, -0.4), -0.5 * 0.4 * 0.75 / J, 1e-11));
  }
}

TEST_CASE("torque_offset: a motor that is told nothing turns the drive forward by a positive offset") {
  for (const By by : every_solver) {
    REQUIRE(close(turned(effects(TorqueOffset<double>{0.3}), by, 0.0), 0.5 * 0.3 / J, 1e-11));
    REQUIRE(close(turned(effects(TorqueOffset<double>{-0.3}), by, 0.1), -0.5 * 0.2 / J, 1e-11));
  }
}

TEST_CASE(
    "gain acts on the limited command, the offset on what the gain left, and the observed torque is the motor's") {
  const auto d = entered(table1(), constant(0.0), constant(5.0),
                         effects(TorqueSaturation<double>{2.0}, TorqueGain<double>{0.5}, TorqueOffset<double>{0.25}));
  REQUIRE(d.observe({0.0, {0.0, 1.0}, {Motion::forward, Flank::left}}).tau_m == 2.0 * 1.5 + 0.25);
}

TEST_CASE(
    "cogging: its torque has the potential amplitude cos(periods theta_w + phase)/periods over the worm's angle") {
  const double A = 0.002, N = 4.0, p = 0.3, omega = 0.4;
  const auto d = drive(smooth(), constant(0.0), constant(0.0), effects(Cogging<double>{A, N, p}));
  const auto potential = [&](double theta_g) { return A / N * std::cos(N * 60.0 * theta_g + p); };
  for (const By by : every_solver) {
    const auto end = after_a_second(d, by, 0.1, omega);
    const double gained = stored_energy(d, end) - stored_energy(d, {0.0, {0.1, omega}, {}});
    REQUIRE(std::abs(gained) >= 1e-5);
    REQUIRE(std::abs(gained + potential(end.x[0]) - potential(0.1)) <= 1e-10);
  }
}

TEST_CASE("torque_map: a line over the speed is viscous friction, and beyond its ends the torque is constant") {
  const double k = 0.5;
  const CubicTable line({-2.0, -0.5, 0.0, 1.0, 2.0}, {1.0, 0.25, 0.0, -0.5, -1.0});  // its ends are flat
  const Effects<double> on = effects(TorqueMap<double>{MapAxis::worm_speed, 1.0, line});
  for (const By by : every_solver) {
    const auto d = flywheel(constant(0.0), 0.0, on);
    REQUIRE(close(after_a_second(d, by, 0.0, 1.0).x[1], std::exp(-k / J), 1e-11));
    REQUIRE(close(after_a_second(d, by, 0.0, 10.0).x[1], 10.0 - 1.0 / J, 1e-11));
  }
}

TEST_CASE("torque_map: a line over the angle is a spring on either shaft, and a factor makes it stiffer") {
  const CubicTable line({-3.0, -1.5, -0.2, 1.5, 3.0}, {3.0, 1.5, 0.2, -1.5, -3.0});  // its ends are flat
  const double omega = std::sqrt(2.0 / J);
  for (const MapShaft shaft : {MapShaft::worm, MapShaft::gear}) {
    const Effects<double> on = effects(TorqueMap<double>{MapAxis::gear_angle, 2.0, line, shaft});
    for (const By by : every_solver) {
      const auto end = after_a_second(flywheel(constant(0.0), 0.0, on), by, 1.0, 0.0);
      REQUIRE(close(end.x[0], std::cos(omega), 1e-10));
      REQUIRE(close(end.x[1], -omega * std::sin(omega), 1e-10));
    }
  }
}

TEST_CASE("torque_map: between teeth a constant is an offset of the motor, and a line over the angle a spring") {
  std::vector<double> angles, torques;
  for (double angle = -8.0; angle < 8.1; angle += 0.5) {
    angles.push_back(angle);
    torques.push_back(-0.01 * angle);
  }
  const CubicTable constant_torque({-9.0, -5.0, 5.0, 9.0}, {3e-3, 3e-3, 3e-3, 3e-3});
  const std::array pairs{
      std::pair{effects(TorqueOffset<double>{3e-3}),
                effects(TorqueMap<double>{MapAxis::worm_speed, 1.0, constant_torque})},
      std::pair{effects(LoadSpring<double>{0.01, 0.0}),
                effects(TorqueMap<double>{MapAxis::gear_angle, 1.0, CubicTable(angles, torques), MapShaft::gear})}};
  for (const auto& [law, map] : pairs)
    for (const By by : every_solver) {
      const auto of = [&](const Effects<double>& on) {
        return run(drive(table1(), fig9_load(), fig9_motor(), on), Timetable(0, 2, 0.05), {}, tight(by));
      };
      const auto stated = of(law), tabulated = of(map);
      REQUIRE(stated.events.size() >= 8);
      REQUIRE(stated.modes() == tabulated.modes());
      REQUIRE((stated.end.x - tabulated.end.x).cwiseAbs().maxCoeff() <= 1e-8);
    }
}

TEST_CASE("bearing_asymmetry: dry friction stops the drive sooner forward than backward") {
  const Effects<double> on = effects(WormCoulomb<double>{0.3}, BearingAsymmetry<double>{0.1, 0.0});
  for (const By by : every_solver) {
    const auto d = flywheel(constant(0.0), 0.0, on);
    REQUIRE(close(after_a_second(d, by, 0.0, 1.0).x[1], 1.0 - 0.4 / J, 1e-11));
    REQUIRE(close(after_a_second(d, by, 0.0, -1.0).x[1], -1.0 + 0.2 / J, 1e-11));
  }
}

TEST_CASE("bearing_asymmetry: viscous friction has another exponential forward than backward") {
  const Effects<double> on = effects(WormViscous<double>{0.5}, BearingAsymmetry<double>{0.0, 0.2});
  for (const By by : every_solver) {
    const auto d = flywheel(constant(0.0), 0.0, on);
    REQUIRE(close(after_a_second(d, by, 0.0, 1.0).x[1], std::exp(-0.7 / J), 1e-11));
    REQUIRE(close(after_a_second(d, by, 0.0, -1.0).x[1], -std::exp(-0.3 / J), 1e-11));
  }
}

TEST_CASE("bearing_asymmetry: at rest it pushes nothing, and breaking away takes more torque forward") {
  const Effects<double> on = effects(WormCoulomb<double>{0.3}, BearingAsymmetry<double>{0.1, 0.0});
  REQUIRE(on.worm_torque(Moment<double>{}, Motion::stuck) == 0.0);
  const auto mode = [&](double torque) {
    auto d = flywheel(constant(0.0), torque, on);
    d.enter(0.0);
    return d.settle({}).motion;
  };
  REQUIRE((mode(0.399) == Motion::stuck && mode(0.401) == Motion::forward));
  REQUIRE((mode(-0.199) == Motion::stuck && mode(-0.201) == Motion::backward));
}

TEST_CASE("worm_inertia and gear_inertia: the drive is the one whose mesh states the sums, to the last bit") {
  MeshParameters<double> sum = table1();
  sum.Jw += 1e-5;
  sum.Jg += 2e-4;
  const auto stated = entered(sum, fig9_load(), fig9_motor());
  const auto added =
      entered(table1(), fig9_load(), fig9_motor(), effects(WormInertia<double>{1e-5}, GearInertia<double>{2e-4}));
  REQUIRE(stated.Jg() == added.Jg());
  REQUIRE(stated.surface() == added.surface());
  for (const Mode mode : moving_modes) {
    const auto at = stated.moment(0.1, 0.4, sign(mode.motion) * 1.0);
    REQUIRE(stated.acceleration(at, mode) == added.acceleration(at, mode));
  }
  REQUIRE(stored_energy(stated, {0.0, {0.0, 2.0}, {}}) == stored_energy(added, {0.0, {0.0, 2.0}, {}}));
}

TEST_CASE("worm_inertia: without a gear 0.5 kg m^2 on a wheel of 2 turns a parabola of torque/2.5") {
  for (const By by : every_solver) {
    REQUIRE(close(turned(effects(WormInertia<double>{0.5}), by, 0.4), 0.5 * 0.4 / 2.5, 1e-11));
    REQUIRE(close(turned(effects(GearInertia<double>{-0.5}), by, 0.4), 0.5 * 0.4 / 1.5, 1e-11));
  }
}

TEST_CASE("load_magnitude: a tenth more load is a tenth more torque on the gear, and the inertia stays") {
  GravityArm arm;
  arm.amplitude = 0.5;
  arm.own_inertia = 0.1;
  const auto d = entered(table1(), arm, constant(0.0), effects(LoadMagnitude<double>{0.1}));
  REQUIRE(close(d.observe({0.0, {0.3, 1.0}, {Motion::forward, Flank::left}}).tau_l, 0.55 * std::cos(0.3), 1e-15));
  REQUIRE(d.Jg() == table1().Jg + 0.1);
}

TEST_CASE("load_angle: an arm that sits 0.2 rad further on is the arm whose offset is 0.2 rad more") {
  GravityArm arm = fig9_load(), further = fig9_load();
  further.offset = 0.2;
  const auto shifted = entered(table1(), arm, fig9_motor(), effects(LoadAngle<double>{0.2}));
  const auto stated = entered(table1(), further, fig9_motor());
  for (const Mode mode : moving_modes) {
    const auto at = stated.moment(0.1, 0.4, sign(mode.motion) * 1.0);
    REQUIRE(close(shifted.acceleration(at, mode), stated.acceleration(at, mode), 1e-14));
  }
}

TEST_CASE(
    "load_spring: a flywheel on a spring swings about the angle of rest with the root of stiffness over inertia") {
  const double k = 3.0, rest = 0.5;
  for (const By by : every_solver) {
    const auto d = flywheel(constant(0.0), 0.0, effects(LoadSpring<double>{k, rest}));
    const auto end = after_a_second(d, by, rest + 0.2, 0.0);
    const double omega = std::sqrt(k / J);
    REQUIRE(std::abs(end.x[0] - (rest + 0.2 * std::cos(omega))) <= 1e-11);
    REQUIRE(std::abs(end.x[1] - -0.2 * omega * std::sin(omega)) <= 1e-11);
  }
}

TEST_CASE("load_spring: a heavier load leaves the spring as it is, and the spring sees the gear's own angle") {
  const auto d = entered(table1(), constant(0.4), constant(0.0),
                         effects(LoadMagnitude<double>{0.5}, LoadAngle<double>{9.0}, LoadSpring<double>{2.0, 0.1}));
  const double tau_l = d.observe({0.0, {0.3, 1.0}, {Motion::forward, Flank::left}}).tau_l;
  REQUIRE(close(tau_l, 0.4 * 1.5 - 2.0 * 0.2, 1e-14));
}

TEST_CASE("encoder_scale: the encoder shows 1 + share of the angle, then the offset, and the motion is untouched") {
  const Effects<double> on = effects(EncoderScale<double>{0.02}, EncoderOffset<double>{0.1});
  REQUIRE(close(on.measured_angle(-2.0), -2.04 + 0.1, 1e-15));
  for (const By by : every_solver) {
    const auto with = after_a_second(drive(table1(), fig9_load(), fig9_motor(), on), by, 0.1, 0.0);
    const auto without = after_a_second(drive(table1(), fig9_load(), fig9_motor()), by, 0.1, 0.0);
    REQUIRE(with.x == without.x);
  }
}

TEST_CASE("the steady command is what makes the motor give the steady torque") {
  const auto bare = entered(table1(), constant(0.5), constant(0.0));
  const auto d =
      entered(table1(), constant(0.5), constant(0.0), effects(TorqueGain<double>{0.25}, TorqueOffset<double>{0.003}));
  const double needed = steady_torque(bare, 60.0, 0.0, 0.0);
  REQUIRE(close(needed, -bare.mesh().C1() * 0.5, 1e-15));
  REQUIRE(close(steady_torque(d, 60.0, 0.0, 0.0), (needed - 0.003) / 1.25, 1e-14));
}

TEST_CASE("with every effect on, motor and load still pay for friction and kinetic energy and nothing else") {
  MeshParameters<double> p = closing(table1());
  const CubicTable falls({0.0, 0.1, 0.3, 1.0}, {0.1, 0.05, -0.05, -0.1});
  const auto d = entered(
      p, fig9_load(), fig9_motor(),
      effects(DcMotor<double>{1.2, 0.025}, TorqueGain<double>{0.1}, TorqueOffset<double>{1e-3},
              Cogging<double>{2e-3, 4.0, 0.1}, WormCoulomb<double>{2e-3}, WormViscous<double>{2e-5},
              WormLuGre<double>{1e-3, 2e-3, 30.0}, BearingAsymmetry<double>{1e-3, 1e-5}, HoldingBrake<double>{1e-3},
              WormInertia<double>{1e-6}, MeshFriction<double>{0.01}, Stribeck<double>{0.1, 0.2, 2.0},
              FrictionAsymmetry<double>{0.02}, PositionFriction<double>{0.2, 0.4}, ThreadFriction<double>{0.1, 0.9},
              FrictionMap<double>{FrictionAxis::sliding_speed, FrictionValue::share, 1.0, falls},
              FrictionDrift<double>{0.1, 2.0}, GearboxHeat<double>{0.01, 1e-5, 0.02, {}, {}, 30.0},
              GearCoulomb<double>{3e-3}, GearViscous<double>{1e-3}, FrictionUnderLoad<double>{0.2},
              GearInertia<double>{1e-4}, LoadMagnitude<double>{0.2}, LoadAngle<double>{0.1},
              LoadSpring<double>{0.01, 0.2}, LoadFourBar<double>{0.0, 0.03, 0.07, 0.06, 0.08, 0.4},
              LoadCoupling<double>{1e-4}),
      0.1);
  for (const double theta : {-1.0, 0.3, 2.0})
    for (const double speed : {0.2, 1.5})
      for (const Motion motion : {Motion::forward, Motion::backward}) {
        auto now = decltype(d)::Instant{0.1, {theta, sign(motion) * speed}, {}};
        now.mode = d.settle(now);
        const Power flow = power(d, now);
        const double gained = 2.0 * stored_energy(d, {0.0, {0.0, 1.0}, {}}) * d.observe(now).alpha_g * now.x[1];
        REQUIRE(flow.loss > 0.0);
        REQUIRE(std::abs(flow.motor + flow.load - flow.loss - gained) <=
                1e-12 * (std::abs(flow.motor) + std::abs(flow.load)));
      }
}

}  // namespace wormdrive::test::core_effects_torques
