#include <array>
#include <cmath>

#include "catch.hpp"
#include "support.hpp"

// Motions whose solution is a formula: every event time and state is compared with it, for every solver.

namespace wormdrive::test::events_closed_forms {

namespace {

constexpr Mode forward_left{Motion::forward, Flank::left}, forward_right{Motion::forward, Flank::right},
    backward_left{Motion::backward, Flank::left}, backward_right{Motion::backward, Flank::right}, stuck{};

constexpr auto& methods = every_solver;

double relative(double a, double b) { return (a - b) / b; }

/// Angle and speed after s seconds from theta, omega under an acceleration alpha + jerk s.
struct ConstantJerk {
  double theta, omega, alpha, jerk = 0.0;

  double angle(double s) const { return theta + s * (omega + s * (alpha / 2 + s * jerk / 6)); }
  double speed(double s) const { return omega + s * (alpha + s * jerk / 2); }
};

}  // namespace

TEST_CASE("a load that brakes the motion stops a self-locking drive for good, at the end of a parabola") {
  const MeshParameters<double> p = table1();
  const double tau_l = -0.013, omega = 1.7;
  const double alpha = Branch(p, forward_right).acceleration(0.0, tau_l);
  const double stop = -omega / alpha, angle = 0.2 - omega * omega / (2 * alpha);
  for (By method : methods) {
    const auto r =
        run(drive(p, constant(tau_l), constant(0.0)), Timetable(0, 5, 0.05), {0.0, {0.2, omega}, {}}, tight(method));
    REQUIRE(r.modes() == std::vector{forward_right, stuck});
    REQUIRE(std::abs(relative(r.events[0].after.t, stop)) <= 1e-12);
    REQUIRE(std::abs(relative(r.end.x[0], angle)) <= 1e-12);
    REQUIRE(r.end.x[1] == 0.0);
    const ConstantJerk braking{0.2, omega, alpha};
    Deviation angles, speeds;
    for (const auto& row : r.rows) {
      if (row.now.t > stop) break;
      angles.add(relative(row.now.x[0], braking.angle(row.now.t)));
      speeds.add((row.now.x[1] - braking.speed(row.now.t)) / omega);
    }
    REQUIRE(angles <= 1e-12);
    REQUIRE(speeds <= 1e-12);
  }
}

TEST_CASE("a motor torque against the motion decelerates, reverses and accelerates along two parabolas") {
  const MeshParameters<double> p = table1();
  const double tau_m = -0.004, omega = 0.9, end = 2.0;
  const double braking = Branch(p, forward_left).acceleration(tau_m, 0.0);
  const double speeding = Branch(p, backward_left).acceleration(tau_m, 0.0);
  const double turn = -omega / braking;
  const ConstantJerk back{-omega * omega / (2 * braking), 0.0, speeding};
  for (By method : methods) {
    const auto r =
        run(drive(p, constant(0.0), constant(tau_m)), Timetable(0, end, 0.05), {0.0, {0.0, omega}, {}}, tight(method));
    REQUIRE(r.modes() == std::vector{forward_left, backward_left});
    REQUIRE(std::abs(relative(r.events[0].after.t, turn)) <= 1e-12);
    REQUIRE(r.events[0].after.x[1] == 0.0);
    REQUIRE(std::abs(relative(r.end.x[0], back.angle(end - turn))) <= 1e-12);
    REQUIRE(std::abs(relative(r.end.x[1], back.speed(end - turn))) <= 1e-12);
  }
}

TEST_CASE("steps of the torque break away, change the flank in motion, reverse and stick, each on its parabola") {
  const MeshParameters<double> p = table1();
  const double load = 0.02;
  // lifting against the load, pulled over the surface at 0.1 s, pushed back at 0.3 s, let go at 0.7 s
  const Signal motor{{Step{0.05, 0.02}, Step{-0.02, 0.1}, Step{-0.075, 0.3}, Step{0.045, 0.7}}};
  const double tau[] = {0.05, 0.03, -0.045, 0.0};
  const ConstantJerk first{0, 0, Branch(p, forward_right).acceleration(tau[0], load)};
  const ConstantJerk second{first.angle(0.08), first.speed(0.08), Branch(p, forward_left).acceleration(tau[1], load)};
  const ConstantJerk third{second.angle(0.2), second.speed(0.2), Branch(p, forward_left).acceleration(tau[2], load)};
  const double turn = 0.3 - third.omega / third.alpha;
  const ConstantJerk fourth{third.angle(turn - 0.3), 0, Branch(p, backward_left).acceleration(tau[2], load)};
  const ConstantJerk fifth{fourth.angle(0.7 - turn), fourth.speed(0.7 - turn),
                           Branch(p, backward_left).acceleration(tau[3], load)};
  const double stop = 0.7 - fifth.omega / fifth.alpha;
  REQUIRE((turn > 0.3 && turn < 0.7 && stop > 0.7));
  for (By method : methods) {
    const auto r = run(drive(p, constant(load), motor), Timetable(0, stop + 1.0, 0.01), {}, tight(method));
    REQUIRE(r.modes() == std::vector{stuck, forward_right, forward_left, backward_left, stuck});
    REQUIRE(r.events[0].after.t == 0.02);
    REQUIRE(r.events[1].after.t == 0.1);
    REQUIRE(std::abs(relative(r.events[2].after.t, turn)) <= 1e-12);
    REQUIRE(std::abs(relative(r.events[3].after.t, stop)) <= 1e-12);
    REQUIRE(std::abs(relative(r.events[2].after.x[0], fourth.theta)) <= 1e-12);
    REQUIRE(std::abs(relative(r.end.x[0], fifth.angle(stop - 0.7))) <= 1e-12);
  }
}

TEST_CASE("a ramp breaks away at -C1 tau_l, crosses the surface and speeds up along two cubics") {
  const MeshParameters<double> p = table1();
  const double load = 0.03, rate = 0.04, end = 2.0, surface = p.Jw * p.i / p.Jg;
  const Branch low(p, forward_left), high(p, forward_right);
  const double released = -low.C * load / rate, crossed = surface * load / rate;
  const ConstantJerk first{0, 0, 0, rate / low.M};
  const double lasted = crossed - released;
  const ConstantJerk second{first.angle(lasted), first.speed(lasted), load / p.Jg, rate / high.M};
  for (By method : methods) {
    const auto r = run(drive(p, constant(load), Signal{{Ramp{rate}}}), Timetable(0, end, 0.05), {}, tight(method));
    REQUIRE(r.modes() == std::vector{stuck, forward_left, forward_right});
    REQUIRE(std::abs(relative(r.events[0].after.t, released)) <= 1e-12);
    REQUIRE(std::abs(relative(r.events[1].after.t, crossed)) <= 1e-12);
    REQUIRE(std::abs(relative(r.end.x[0], second.angle(end - crossed))) <= 1e-12);
    REQUIRE(std::abs(relative(r.end.x[1], second.speed(end - crossed))) <= 1e-12);
  }
}

TEST_CASE("viscous friction alone lets the speed decay exponentially, on either shaft and without a gear") {
  const MeshParameters<double> p = table1();
  const double omega = 2.0, end = 0.5, c = 1e-4, cg = 5e-3;
  // the worm's friction holds the worm back: the teeth touch left; the gear's holds the gear back: right
  const Branch left(p, forward_left), right(p, forward_right);
  const auto decays = [&](const auto& d, double rate, By method) {
    const auto r = run(d, Timetable(0, end, 0.05), {0.0, {0.0, omega}, {}}, tight(method));
    REQUIRE(r.events.empty());
    REQUIRE(std::abs(relative(r.end.x[1], omega * std::exp(-rate * end))) <= 1e-11);
    REQUIRE(std::abs(relative(r.end.x[0], -omega / rate * std::expm1(-rate * end))) <= 1e-11);
  };
  for (By method : methods) {
    decays(drive(p, constant(0.0), constant(0.0), effects(WormViscous<double>{c})), c * p.i / left.M, method);
    decays(drive(p, constant(0.0), constant(0.0), effects(GearViscous<double>{cg})), right.C * cg / right.M, method);
    decays(WormDrive(GearMesh<double>::without_teeth(0.02), make_load(constant(0.0)), effects(GearViscous<double>{0.1}),
                     constant(0.0)),
           0.1 / 0.02, method);
  }
}

TEST_CASE("under gravity the energy integral of one mode is constant from its first to its last row") {
  const MeshParameters<double> p = table1();
  GravityArm arm = fig9_load();
  arm.offset = 0.4;
  const double tau_m = -0.01;
  for (By method : methods) {
    const auto r = run(drive(p, arm, constant(tau_m)), Timetable(0, 1.5, 0.01), {0.0, {0.1, 2.0}, {}}, tight(method));
    REQUIRE(r.events.size() >= 2);
    Deviation drift;
    double begin = 0.0;
    const Mode* mode = nullptr;
    for (const auto& row : r.rows) {
      if (row.now.mode.motion == Motion::stuck) continue;
      const Branch in(p, row.now.mode);
      const double integral = 0.5 * in.M * row.now.x[1] * row.now.x[1] - tau_m * row.now.x[0] -
                              in.C * 0.0196 * std::sin(row.now.x[0] + arm.offset);
      if (!mode || *mode != row.now.mode) begin = integral;
      drift.add(integral - begin);
      mode = &row.now.mode;
    }
    REQUIRE(drift <= 1e-10);
  }
}

}  // namespace wormdrive::test::events_closed_forms
