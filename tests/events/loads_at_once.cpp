#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "core/load.hpp"
#include "core/states/starting_state.hpp"
#include "events/runge_kutta.hpp"
#include "events/slider_crank.hpp"
#include "numbers.hpp"
#include "support.hpp"

// A brake, a coupling, a crank behind it, an arm, a fan, gusts and a stop, all at once, against a program of fixed
// steps that shares no code with the drive.

namespace wormdrive::test::events_loads_at_once {

namespace {

constexpr double J1 = 2e-3, J2 = 5e-3, k = 9.0, damping = 4e-3;        // shaft, load and coupling
constexpr double brake = 0.6, opens = 0.21, closes = 1.63, end = 2.2;  // [N m], [s]
constexpr double drive_torque = 0.9, drive_omega = 4.1;                // of the motor
constexpr double arm_torque = 0.4, arm_angle = 0.3;                    // gravity
constexpr double gust = 0.1, gust_omega = 23.0;                        // wind
constexpr double drag = 0.01;                                          // fan, over the square of the speed
constexpr double stop_angle = 1.1, stop_stiffness = 60.0, stop_damping = 0.2;
const LoadCrank<double> crank{1.5, 0.04, 0.1, 0.5};

/// Angle and speed of the shaft, twist, speed of the load.
using State = Eigen::Vector4d;

class FixedSteps {
 public:
  explicit FixedSteps(double step, double twist) : now(0.0, 0.0, twist, 0.0) {
    for (const double until : {opens, closes, end}) {
      braking_ = until == opens || until == end ? brake : 0.0;
      motion_ = now[1] != 0.0 ? (now[1] > 0.0 ? 1 : -1) : free();
      while (t_ < until) advance(std::min(step, until - t_));
      t_ = until;
    }
  }
  State now;
  int changes = 0;
  double deepest = 0.0;  ///< in the stop [rad]

 private:
  double motor(double t) const { return drive_torque * std::sin(drive_omega * t); }
  static double coupling(const State& x) { return k * x[2] + damping * (x[3] - x[1]); }
  State rates(double t, const State& x) const {
    const double angle = x[0] + x[2], depth = std::max(0.0, angle - stop_angle);
    const double push = std::max(0.0, stop_stiffness * depth * (1.0 + stop_damping * x[3]));
    const double load = arm_torque * std::cos(angle + arm_angle) + gust * std::sin(gust_omega * t) -
                        drag * x[3] * std::abs(x[3]) - push - half_slope(crank, angle) * x[3] * x[3];
    const double on_shaft = motor(t) + coupling(x) - motion_ * braking_;
    return {motion_ == 0 ? 0.0 : x[1], motion_ == 0 ? 0.0 : on_shaft / J1, x[3] - (motion_ == 0 ? 0.0 : x[1]),
            (load - coupling(x)) / (J2 + inertia(crank, angle))};
  }
  State moved(double h) const {
    return runge_kutta([this](double t, const State& x) { return rates(t, x); }, t_, now, h);
  }
  /// Where the shaft goes from rest.
  int free() const {
    const double torque = motor(t_) + coupling(now);
    return torque > braking_ ? 1 : torque < -braking_ ? -1 : 0;
  }
  /// On which side of the stop the load is, and which way it turns: there the torques bend.
  static int side(const State& x) { return (x[0] + x[2] > stop_angle ? 2 : 0) + (x[3] > 0.0 ? 1 : 0); }
  bool keeps_motion(double h, const State& then) const {
    return motion_ == 0 ? std::abs(motor(t_ + h) + coupling(then)) <= braking_ : motion_ * then[1] >= 0.0;
  }
  bool holds(double h) const {
    const State then = moved(h);
    return side(then) == side_ && keeps_motion(h, then);
  }
  void advance(double h) {
    side_ = side(now);
    if (!holds(h)) h = end_of(0.0, h, [&](double s) { return holds(s); });
    const State then = moved(h);
    const bool keeps = keeps_motion(h, then);
    now = then;
    t_ += h;
    deepest = std::max(deepest, now[0] + now[2] - stop_angle);
    if (keeps) return;
    ++changes;
    if (motion_ != 0) now[1] = 0.0;
    motion_ = free();
  }

  double t_ = 0.0, braking_ = 0.0;
  int motion_ = 0, side_ = 0;
};

}  // namespace

TEST_CASE(
    "brake, coupling, crank, arm, fan, gusts and stop at once agree with fixed steps, the better the finer these") {
  GravityArm arm;
  arm.amplitude = arm_torque;
  arm.offset = arm_angle;
  Fan fan;
  fan.rated_torque = drag;
  fan.rated_speed = 1.0;
  EndStops stop;
  stop.high = stop_angle;
  stop.stiffness = stop_stiffness;
  stop.damping = stop_damping;
  const auto sine = [](double amplitude, double omega) {
    return Sinusoid{amplitude, omega / (2.0 * std::numbers::pi), -0.5 * std::numbers::pi};
  };
  const auto d = [&] {
    auto made = drive_with_states(
        GearMesh<double>::without_teeth(J1), LoadSum{{arm, fan, stop, sine(gust, gust_omega)}},
        Signal{{sine(drive_torque, drive_omega)}},
        effects(HoldingBrake<double>{brake, opens, closes}, LoadCoupling<double>{J2, k, damping}, crank));
    made.enter(0.0);
    return made;
  }();
  typename decltype(d)::Instant start;
  start.x = starting_state(d, {}, 0.0);
  constexpr int twist = 2 + int{StateLayout<EffectList<double>>::first<LoadCoupling<double>>()};
  std::vector<FixedSteps> judges;
  for (const double step : {4e-4, 2e-4, 1e-4, 2.5e-5}) judges.emplace_back(step, start.x[twist]);
  REQUIRE(judges.back().changes >= 4);
  REQUIRE(judges.back().deepest > 0.01);
  for (const By by : every_solver) {
    INFO(static_cast<int>(by.solver) << static_cast<int>(by.method));
    const auto seen = run(d, Timetable(0, end, 0.01), start, tight(by));
    const State x(seen.end.x[0], seen.end.x[1], seen.end.x[twist], seen.end.x[twist + 1]);
    std::vector<double> off;
    for (const FixedSteps& judge : judges) off.push_back((judge.now - x).cwiseAbs().maxCoeff());
    INFO(off[0] << " " << off[1] << " " << off[2] << " " << off[3]);
    CHECK(off[1] < 0.1 * off[0]);  // of order 4
    CHECK(off[2] < 0.1 * off[1]);
    CHECK(off[3] <= 2e-10);
  }
}

}  // namespace wormdrive::test::events_loads_at_once
