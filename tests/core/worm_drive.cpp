#include "core/worm_drive.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <Eigen/LU>

#include "catch.hpp"
#include "support.hpp"

namespace wormdrive::test::core_worm_drive {

namespace {

using GravityDrive = WormDrive<double, GravityLoad>;

/// A loaded drive with everything on that can make its Jacobian interesting.
GravityDrive rich_drive() {
  GravityArm arm;
  arm.mass = 1.0;
  arm.arm = 0.07;
  arm.offset = 0.3;
  return entered(table1(), arm, fig9_motor(),
                 effects(WormCoulomb<double>{0.002}, WormViscous<double>{1e-4}, GearCoulomb<double>{0.01},
                         GearViscous<double>{0.02}));
}

/// The two bodies of eq. 1-5 with the mesh force between them, solved for theta_g'' and Wn in one mode.
struct TwoBodies {
  double alpha, Wn;
};
TwoBodies solve_eq_1_to_5(const MeshParameters<double>& p, double Jg, Mode mode, double tau_w, double tau_g) {
  const double c = std::cos(p.lambda), s = std::sin(p.lambda), cos_phi = std::cos(p.phi_n);
  const double f = sign(mode.flank), Wf = sign(mode.motion) * p.mu;  // Wf per Wn
  Eigen::Matrix2d A;
  A << p.Jw * p.i, -(f * cos_phi * s - Wf * c) * p.lw,  //
      Jg, (f * cos_phi * c + Wf * s) * p.lg;
  const Eigen::Vector2d x = A.fullPivLu().solve(Eigen::Vector2d(tau_w, tau_g));
  return {x[0], x[1]};
}

/// Torques tau_m at a distance from the switching surface that a mode's flank can carry.
double torque_on(Mode mode, double surface, double tau_l, double distance) {
  return surface * tau_l - sign(mode.flank) * distance;
}

}  // namespace

TEST_CASE("eliminating the normal force from the two bodies gives the acceleration and Wn > 0 in each of four modes") {
  std::mt19937 random(18);
  std::uniform_real_distribution<double> unit_interval(0.0, 1.0);
  const auto between = [&](double low, double high) { return low + (high - low) * unit_interval(random); };
  Deviation alpha, Wn;
  double smallest_Wn = std::numeric_limits<double>::infinity();
  for (int trial = 0; trial < 500; ++trial) {
    MeshParameters<double> p = table1();
    p.lambda = between(0.02, 0.7);
    p.phi_n = between(0.0, 0.5);
    p.i = between(5.0, 100.0);
    p.Jg = between(1e-4, 1e-2);
    p.mu = between(0.0, 0.9) * std::min(1.0, GearMesh<double>(p).mu_g());
    if (GearMesh<double>(p).C1() * p.Jg <= -p.Jw * p.i) continue;  // eq. 17: jammed, nothing to compare
    for (const Mode& mode : moving_modes) {
      const double tau_l = between(-2.0, 2.0), surface = p.Jw * p.i / p.Jg;
      const auto d = entered(p, constant(tau_l), constant(torque_on(mode, surface, tau_l, between(0.01, 2.0))));
      const decltype(d)::Instant now{0.0, {0.3, sign(mode.motion) * 1.5}, mode};
      const Observation seen = d.observe(now);
      const TwoBodies expected = solve_eq_1_to_5(p, p.Jg, mode, seen.tau_m, seen.tau_l);
      const double weakest = p.Jw * p.i + d.mesh().C1() * p.Jg;
      alpha.add((seen.alpha_g - expected.alpha) * weakest / (std::abs(seen.tau_m) + std::abs(tau_l)));
      Wn.add((seen.normal_force - expected.Wn) / (std::abs(tau_l) / p.lg + expected.Wn));
      smallest_Wn = std::min(smallest_Wn, seen.normal_force);
    }
  }
  REQUIRE(alpha <= 1e-12);
  REQUIRE(Wn <= 1e-12);
  REQUIRE(smallest_Wn > 0.0);
}

TEST_CASE("bearings enter the two bodies as torques on their own shafts and change nothing else") {
  const auto d = rich_drive();
  for (const Mode& mode : moving_modes) {
    const auto at = d.moment(0.2, 0.4, sign(mode.motion) * 1.3);
    const auto tau = d.side_torques(at, mode.motion);
    const TwoBodies expected = solve_eq_1_to_5(table1(), d.Jg(), mode, tau.worm, tau.gear);
    REQUIRE(std::abs(d.acceleration(at, mode) - expected.alpha) <= 1e-12 * std::abs(expected.alpha));
    REQUIRE(tau.worm == d.observe({0.2, {0.4, 1.3}, mode}).tau_m - sign(mode.motion) * (0.002 + 1e-4 * 60 * 1.3));
  }
  REQUIRE(d.Jg() == 7.39e-4 + 1.0 * 0.07 * 0.07);
  REQUIRE(std::abs(d.surface() - 2.53e-5 * 60 / d.Jg()) <= 1e-16);
}

TEST_CASE("the Jacobian agrees with central differences in every mode, stuck included") {
  const auto d = rich_drive();
  std::vector<Mode> modes(std::begin(moving_modes), std::end(moving_modes));
  modes.push_back({});
  for (const Mode& mode : modes) {
    const GravityDrive::State x(0.4, sign(mode.motion) * 1.3);
    const auto J = d.jacobian(0.2, x, mode);
    for (int k = 0; k < 2; ++k) {
      const double h = 1e-5;
      GravityDrive::State ahead = x, behind = x;
      ahead[k] += h;
      behind[k] -= h;
      const GravityDrive::State slope = (d.derivative(0.2, ahead, mode) - d.derivative(0.2, behind, mode)) / (2.0 * h);
      REQUIRE((J.col(k) - slope).cwiseAbs().maxCoeff() <= 1e-8 * (1.0 + slope.cwiseAbs().maxCoeff()));
    }
    REQUIRE((J.isZero() == (mode.motion == Motion::stuck)));
  }
}

TEST_CASE("on the switching surface both flanks give tau_l/Jg: the acceleration is continuous there") {
  const MeshParameters<double> p = table1();
  for (double tau_l : {-0.7, 0.02, 1.4}) {
    const auto d = entered(p, constant(tau_l), constant(p.Jw * p.i / p.Jg * tau_l));
    for (const Mode& mode : moving_modes) {
      const auto at = d.moment(0.0, 0.0, sign(mode.motion) * 1.0);
      REQUIRE(std::abs(d.acceleration(at, mode) - tau_l / p.Jg) <= 1e-12 * std::abs(tau_l / p.Jg));
      REQUIRE(d.observe({0.0, {0.0, double(sign(mode.motion))}, mode}).normal_force <= 1e-10);
    }
  }
}

TEST_CASE("at a reversal under load the acceleration jumps") {
  const auto d = entered(table1(), constant(0.3), constant(0.2));
  const auto at = d.moment(0.0, 0.0, 0.0);
  REQUIRE(std::abs(d.acceleration(at, {Motion::forward, Flank::left}) -
                   d.acceleration(at, {Motion::backward, Flank::left})) > 1.0);
}

TEST_CASE("a drive mirrored in angle, speed and torques moves as its mirror image") {
  GravityArm odd;  // the cosine, turned by 90 degrees, is an odd function of the angle
  odd.amplitude = 0.0196;
  odd.offset = 90 * unit::degree;
  Signal mirrored = fig9_motor();
  std::get<Sinusoid>(mirrored.terms[0]).amplitude *= -1.0;
  const Timetable reports(0, 2, 0.01);
  // rounding differs and so do the steps: what BDF leaves as error at its tightest is more than is asked for here
  const SolverSettings fine = tight(adams);
  const auto one = run(drive(table1(), odd, fig9_motor()), reports, {0.0, {0.2, 1.0}, {}}, fine);
  const auto other = run(drive(table1(), odd, mirrored), reports, {0.0, {-0.2, -1.0}, {}}, fine);
  REQUIRE(one.events.size() >= 8);
  REQUIRE(one.events.size() == other.events.size());
  for (std::size_t k = 0; k < one.events.size(); ++k) {
    const auto &a = one.events[k].after, &b = other.events[k].after;
    REQUIRE(std::abs(a.t - b.t) <= 1e-12);
    REQUIRE(sign(a.mode.motion) == -sign(b.mode.motion));
    REQUIRE(sign(a.mode.flank) == -sign(b.mode.flank));
  }
  REQUIRE((one.end.x + other.end.x).cwiseAbs().maxCoeff() <= 1e-11);
}

TEST_CASE("a series along the motion has the derivatives that the equation demands") {
  const auto d = rich_drive();
  const GravityDrive::Instant now{0.2, {0.4, 1.3}, {Motion::forward, Flank::left}};
  const auto at = d.ahead<6>(now);
  REQUIRE(at.omega_g[1] == d.acceleration(d.moment(now), now.mode));
  // one step of the classical Runge-Kutta method, whose error is of fifth order, against the series
  const double h = 1e-4;
  const auto f = [&](double s, const GravityDrive::State& x) { return d.derivative(0.2 + s, x, now.mode); };
  const GravityDrive::State k1 = f(0, now.x), k2 = f(h / 2, now.x + h / 2 * k1), k3 = f(h / 2, now.x + h / 2 * k2),
                            k4 = f(h, now.x + h * k3), stepped = now.x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  GravityDrive::State summed = GravityDrive::State::Zero();
  for (int k = 6; k >= 0; --k) summed = summed * h + GravityDrive::State(at.theta_g[k], at.omega_g[k]);
  REQUIRE((summed - stepped).cwiseAbs().maxCoeff() <= 1e-14);
}

TEST_CASE("guards are positive inside their mode and name the boundary that ends it") {
  const auto d = entered(table1(), constant(0.3), constant(0.2));
  const auto moving = d.guards(d.moment(0.0, 0.0, 1.0), {Motion::forward, Flank::left});
  REQUIRE((moving[0] == 1.0 && moving[1] > 0.0));
  REQUIRE(d.guards(d.moment(0.0, 0.0, 1.0), {Motion::forward, Flank::right})[1] == -moving[1]);
  REQUIRE(d.guards(d.moment(0.0, 0.0, 1.0), {Motion::backward, Flank::left})[0] == -1.0);
  const auto held = entered(table1(), constant(0.3), constant(0.0));
  for (double margin : held.guards(held.moment(0.0, 0.0, 0.0), {})) REQUIRE(margin > 0.0);

  REQUIRE(GravityDrive::guard_name({}, GravityDrive::forward_guard) == "forward break-in");
  REQUIRE(GravityDrive::guard_name({}, GravityDrive::backward_guard) == "backward break-in");
  REQUIRE(GravityDrive::guard_name(moving_modes[0], GravityDrive::speed_guard) == "gear speed");
  REQUIRE(GravityDrive::guard_name(moving_modes[0], GravityDrive::flank_guard) == "switching surface");
}

TEST_CASE("a single inertia has no flank and no normal force; only its bearings hold it") {
  const WormDrive<double, TimedLoad> d(GearMesh<double>::without_teeth(2.0), TimedLoad{constant(0.0)},
                                       effects(GearCoulomb<double>{0.5}), constant(0.4));
  auto pushed = d;
  pushed.enter(0.0);
  REQUIRE(pushed.settle({}) == Mode{});
  REQUIRE(pushed.settle({0.0, {0.0, 1.0}, {}}) == Mode{Motion::forward, Flank::none});
  REQUIRE(pushed.acceleration(pushed.moment(0.0, 0.0, 1.0), {Motion::forward, Flank::none}) == (0.4 - 0.5) / 2.0);
  REQUIRE(pushed.observe({0.0, {0.0, 1.0}, {Motion::forward, Flank::none}}).normal_force == 0.0);
}

}  // namespace wormdrive::test::core_worm_drive
