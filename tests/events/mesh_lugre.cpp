#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "core/energy.hpp"
#include "core/statics.hpp"
#include "events/runge_kutta.hpp"
#include "events/torque_ratio.hpp"
#include "near_ties/dice.hpp"
#include "numbers.hpp"
#include "support.hpp"

// Bristles between the teeth: Dahl's closed form along the way by which they slide, a program of fixed steps that knows
// neither modes nor events, and the paper's drive as the limit of bristles that do not bend.

namespace wormdrive::test::events_mesh_lugre {

namespace {

constexpr int bristles = 2 + int{StateLayout<EffectList<double>>::first<MeshLuGre<double>>()};

/// A worm drive that a torque swings against an arm, with teeth on bristles.
struct Case {
  MeshParameters<double> p;
  GravityArm arm;
  Sinusoid push;
  MeshLuGre<double> teeth;
  double slides;  ///< way after which they slide [m]
  double end;
};

Case drawn_case(near_ties::Dice& dice, bool damped) {
  Case c{};
  c.p = table1(dice.between(0.05, 0.3));
  c.arm.amplitude = dice.decades(0.01, 0.3);
  c.arm.offset = dice.between(-3.0, 3.0);
  c.push.frequency = dice.decades(0.5, 5.0);
  c.push.amplitude = torque_ratio(c.p, -c.p.mu) * *c.arm.amplitude * dice.decades(1.2, 5.0);
  c.push.phase = dice.between(-3.0, 3.0);
  c.slides = c.p.lw / std::cos(c.p.lambda) * c.p.i * dice.decades(3e-4, 3e-2);
  c.teeth.stiffness = c.p.mu / c.slides;
  if (damped) c.teeth.damping = c.teeth.stiffness / c.push.frequency * dice.decades(1e-4, 3e-3);
  c.end = 2.0 / c.push.frequency;
  return c;
}

/// Angle, speed and bristles by fixed steps of Runge and Kutta, whatever happens on the way.
class FixedSteps {
 public:
  explicit FixedSteps(const Case& c) : c_(c) {}
  Eigen::Vector3d operator()(int steps) const {
    Eigen::Vector3d x(0.0, 0.0, 0.0);
    const double h = c_.end / steps;
    for (int k = 0; k < steps; ++k)
      x = runge_kutta([this](double t, const Eigen::Vector3d& y) { return rates(t, y); }, k * h, x, h);
    return x;
  }

 private:
  Eigen::Vector3d rates(double t, const Eigen::Vector3d& x) const {
    const MeshParameters<double>& p = c_.p;
    const double tau_m = c_.push.amplitude * std::cos(2.0 * std::numbers::pi * c_.push.frequency * t + c_.push.phase);
    const double tau_l = *c_.arm.amplitude * std::cos(x[0] + c_.arm.offset);
    const double v = p.lw * p.i * x[1] / std::cos(p.lambda), bend = v - std::abs(v) * x[2] / p.mu;
    const double friction = x[2] + c_.teeth.damping * bend;
    const double side = tau_m - p.Jw * p.i / p.Jg * tau_l > 0.0 ? -1.0 : 1.0;  // the right flank, or the left one
    const double C = torque_ratio(p, side * friction);
    return {x[1], (tau_m + C * tau_l) / (p.Jw * p.i + C * p.Jg), c_.teeth.stiffness * bend};
  }

  Case c_;
};

auto run_case(const Case& c, By by, double relative = 1e-12) {
  return run(drive_with_states(GearMesh<double>(c.p), c.arm, Signal{{c.push}}, effects(c.teeth)),
             Timetable(0, c.end, c.end / 200.0), {}, tight(by, relative));
}

}  // namespace

TEST_CASE("bristles between teeth follow the solution of Dahl along the way by which these slide") {
  near_ties::Dice dice(20261130, 0);
  int reversals = 0;
  for (int trial = 0; trial < 15; ++trial) {
    const Case c = drawn_case(dice, false);
    const double way_per_angle = c.p.lw * c.p.i / std::cos(c.p.lambda);
    for (const By by : every_solver) {
      INFO(trial);
      const auto seen = run_case(c, by);
      double from = 0.0, bent = 0.0;
      Motion motion = Motion::stuck;
      const auto dahl = [&](double angle) {
        const double slid = std::abs(angle - from) * way_per_angle;
        return sign(motion) - (sign(motion) - bent) * std::exp(-slid / c.slides);
      };
      Deviation off;
      for (const auto& row : seen.rows) {
        if (row.now.mode.motion != motion) {
          bent = dahl(row.now.x[0]);
          from = row.now.x[0];
          motion = row.now.mode.motion;
          ++reversals;
        }
        off.add(row.now.x[bristles] / c.p.mu - dahl(row.now.x[0]));
      }
      CHECK(off <= 1e-8);
    }
  }
  CHECK(reversals > 150);
}

TEST_CASE("drives with bristles between the teeth are where fixed steps take them, the nearer the shorter these are") {
  near_ties::Dice dice(20261131, 0);
  for (int trial = 0; trial < 8; ++trial) {
    const Case c = drawn_case(dice, true);
    const FixedSteps by_steps(c);
    const Eigen::Vector3d rough = by_steps(100'000), fine = by_steps(400'000);
    for (const By by : every_solver) {
      INFO(trial);
      const auto seen = run_case(c, by);
      Eigen::Vector3d end(seen.end.x[0], seen.end.x[1], seen.end.x[bristles]), unit(1.0, c.push.frequency, 1.0);
      const double near = (fine - end).cwiseQuotient(unit).norm(), far = (rough - end).cwiseQuotient(unit).norm();
      CAPTURE(near, far);
      CHECK(near <= 1e-7);
      CHECK((near <= 0.5 * far || far <= 1e-9));
    }
  }
}

TEST_CASE("the paper's drive is the limit of stiff bristles between the teeth, with order 2/3 in their stiffness") {
  const Timetable times(0, 0.3, 0.3);
  const auto dry = run(drive(table1(), fig9_load(), fig9_motor()), times, {}, tight(taylor));
  REQUIRE(dry.end.x[0] < -0.05);
  double before = 0.0;
  for (const double stiffness : {1e7, 1e8, 1e9}) {
    const auto seen = run(drive_with_states(GearMesh<double>(table1()), fig9_load(), fig9_motor(),
                                            effects(MeshLuGre<double>{stiffness, 0.1 * std::sqrt(stiffness)})),
                          times, {}, tight(bdf, 1e-12));
    const double now = std::abs(seen.end.x[0] - dry.end.x[0]);
    INFO("stiffness " << stiffness << ", off by " << now << ", " << seen.events.size() << " events");
    if (before > 0.0) CHECK(std::abs(std::log10(before / now) - 2.0 / 3.0) <= 0.05);
    before = now;
  }
}

TEST_CASE("teeth on bristles hold a load that locks itself, and give way to it by as much as their stiffness says") {
  const MeshParameters<double> p = table1();
  const double load = 0.5, stiffness = 2000.0;
  REQUIRE(GearMesh<double>(p).regime() == LockingRegime::gear_self_locking);
  for (const By by : every_solver) {
    const auto seen = run(
        drive_with_states(GearMesh<double>(p), constant(load), Signal{}, effects(MeshLuGre<double>{stiffness, 10.0})),
        Timetable(0, 3, 0.1), {}, tight(by, 1e-11));
    // C(m) = 0: friction as high as the tangent of the lead angle, reduced by the pressure angle
    const double holds = -std::cos(p.phi_n) * std::tan(p.lambda);
    CHECK(std::abs(std::abs(seen.end.x[bristles]) - std::abs(holds)) <= 1e-9);
    CHECK(std::abs(seen.end.x[1]) <= 1e-9);
    const double slid = p.lw * p.i / std::cos(p.lambda) * std::abs(seen.end.x[0]);
    // z' = v (1 - h/mu) along a way that does not turn back
    CHECK(slid >= std::abs(holds) / stiffness);
    CHECK(slid <= -p.mu / stiffness * std::log(1.0 - std::abs(holds) / p.mu) * 1.5);
  }
}

}  // namespace wormdrive::test::events_mesh_lugre
