#include <array>
#include <cmath>
#include <vector>

#include "catch.hpp"
#include "derivatives.hpp"

// Derivatives of motions whose formulas are known: a single inertia with a dry bearing.

namespace wormdrive::test::events_sensitivity_closed_forms {

namespace {

constexpr double J = 0.02, T = 0.05;  // [kg m^2], [N m]

RigidDrive flywheel(const Signal& motor, double omega) {
  return {GearMesh<double>::without_teeth(J), LoadSum{}, effects(WormCoulomb<double>{T}), motor, {0.0, omega}};
}

/// The derivatives by dry friction, initial speed and inertia at the end of a run, in this order.
Sensitivities derived(const RigidDrive& drive, double end, By by) {
  const std::array which{parameter(drive, "worm_coulomb", "torque"), parameter(drive, "initial", "gear_speed"),
                         parameter(drive, "mesh", "inertia")};
  return sensitivities(drive, which, Timetable(0, end, end), tight(by, 1e-12));
}

void check_row(const Eigen::RowVectorXd& found, const std::array<double, 3>& expected) {
  for (int k = 0; k < 3; ++k) {
    CAPTURE(k, found[k], expected[static_cast<std::size_t>(k)]);
    CHECK(std::abs(found[k] - expected[static_cast<std::size_t>(k)]) <=
          1e-9 * std::max(1.0, std::abs(expected[static_cast<std::size_t>(k)])));
  }
}

}  // namespace

TEST_CASE(
    "a flywheel that dry friction stops: angle and time of the stop have the derivatives of J w^2 / 2 T, J w / T") {
  constexpr double w = 3.0;
  for (const By by : every_solver) {
    const Sensitivities s = derived(flywheel({}, w), 4.0, by);
    REQUIRE(s.events.size() == 2);  // set moving by its initial speed, and stopped
    check_row(s.events.back().time_by, {-J * w / (T * T), J / T, w / T});
    check_row(s.rows.back().state_by.row(0), {-J * w * w / (2 * T * T), J * w / T, w * w / (2 * T)});
    check_row(s.rows.back().state_by.row(1), {0.0, 0.0, 0.0});
  }
}

TEST_CASE("a flywheel that a torque turns back: behind the reversal the derivative of the speed is not what it was") {
  constexpr double w = 3.0, tau = 0.2, end = 1.0;
  // w(t) = w - (tau + T) t / J up to t1 = J w / (tau + T), -(tau - T) (t - t1) / J behind it
  const double t1 = J * w / (tau + T), since = end - t1, back = (tau - T) / J;
  const std::array<double, 3> t1_by{-t1 / (tau + T), J / (tau + T), w / (tau + T)};
  const std::array<double, 3> back_by{-1 / J, 0.0, -back / J};
  std::array<double, 3> speed, angle;
  const std::array<double, 3> turn_by{-t1 * t1 / (2 * J), t1, t1 * w / (2 * J)};  // of w t1 / 2 = J w^2 / 2 (tau + T)
  for (std::size_t k = 0; k < 3; ++k) {
    speed[k] = -back_by[k] * since + back * t1_by[k];
    angle[k] = turn_by[k] - back_by[k] * since * since / 2 + back * since * t1_by[k];
  }
  for (const By by : every_solver) {
    const Sensitivities s = derived(flywheel(constant(-tau), w), end, by);
    REQUIRE(s.events.back().before.motion == Motion::forward);
    REQUIRE(s.events.back().after.motion == Motion::backward);
    check_row(s.events.back().time_by, t1_by);
    check_row(s.rows.back().state_by.row(0), angle);
    check_row(s.rows.back().state_by.row(1), speed);
  }
}

TEST_CASE("across a reversal the derivatives of the speed change in the ratio of the accelerations") {
  constexpr double w = 3.0, tau = 0.2;
  const auto drive = flywheel(constant(-tau), w);
  const double t1 = J * w / (tau + T);
  const std::array which{parameter(drive, "initial", "gear_speed")};
  const auto just = [&](double t) {
    return sensitivities(drive, which, Timetable(0, t, t), tight(taylor, 1e-12)).rows.back().state_by(1, 0);
  };
  const double before = just(t1 - 1e-6), behind = just(t1 + 1e-6);
  REQUIRE(std::abs(before - 1.0) <= 1e-12);
  REQUIRE(std::abs(behind / before - (tau - T) / (tau + T)) <= 1e-9);  // 0.6; carried on unchanged it would stay 1
}

TEST_CASE("a flywheel that a ramp sets off: more friction, later break-away") {
  constexpr double rate = 0.1, end = 1.5, t0 = T / rate, since = end - t0;
  // w(t) = rate (t - t0)^2 / 2 J; a state of rest has no derivative by its own speed
  for (const By by : every_solver) {
    const Sensitivities s = derived(flywheel({{Ramp{rate}}}, 0.0), end, by);
    REQUIRE(s.events.size() == 1);
    check_row(s.events.back().time_by, {1 / rate, 0.0, 0.0});
    check_row(s.rows.back().state_by.row(1), {-since / J, 0.0, -rate * since * since / (2 * J * J)});
    check_row(s.rows.back().state_by.row(0),
              {-since * since / (2 * J), 0.0, -rate * since * since * since / (6 * J * J)});
  }
}

TEST_CASE("a delay of zero has a derivative, also where a torque stands from the start on: all happens later") {
  constexpr double tau = 0.2, at = 0.3, step = 0.1, end = 1.0, a = (tau - T) / J, more = (tau + step - T) / J;
  for (const double w : {0.0, 3.0}) {
    auto drive = flywheel({{Constant{tau}, Step{.torque = step, .time = at}}}, w);
    std::get<std::optional<ActuatorDelay<double>>>(drive.effects.list) = {0.0};
    const std::array which{parameter(drive, "actuator_delay", "delay")};
    const double idle = w > 0.0 ? -T / J : 0.0;  // without a torque it runs down, or stays
    for (const By by : every_solver) {
      const Sensitivities s = sensitivities(drive, which, Timetable(0, end, end), tight(by, 1e-12));
      CHECK(std::abs(s.rows.back().state_by(1, 0) - ((idle - a) + (a - more))) <= 1e-9);
      CHECK(std::abs(s.rows.back().state_by(0, 0) - ((idle - a) * end + (a - more) * (end - at))) <= 1e-9);
    }
  }
}

TEST_CASE("torques held from sample to sample are taken as given") {
  // forward, on, back through a reversal, held by the bearing
  const std::vector<double> torques{0.15, 0.10, -0.30, -0.30, 0.14, 0.02, 0.02, 0.02, 0.02, 0.02};
  constexpr double period = 0.1, end = 1.0;
  const auto drive = flywheel({}, 0.0);
  for (const By by : every_solver) {
    std::size_t next = 0;
    const auto recorded = [&](double, double) { return torques.at(next++); };
    const std::array which{parameter(drive, "worm_coulomb", "torque")};
    const Sensitivities s =
        sensitivities(drive, which, Timetable(0, end, end, {period, 0.0}), tight(by, 1e-12), recorded);
    // in closed form from sample to sample, friction T and its derivative carried by hand
    using Jet = ceres::Jet<double, 1>;
    const Jet friction(T, 0);
    Jet theta(0.0), omega(0.0);
    for (const double tau : torques) {
      Jet left(period);
      for (int leg = 0; leg < 2 && left.a > 0.0; ++leg) {
        const double side = omega.a != 0.0      ? std::copysign(1.0, omega.a)
                            : std::abs(tau) > T ? std::copysign(1.0, tau)
                                                : 0.0;
        if (side == 0.0) break;
        const Jet a = (tau - side * friction) / J;
        const Jet stop = -omega / a;
        const bool stops = omega.a != 0.0 && stop.a > 0.0 && stop.a < left.a;
        const Jet span = stops ? stop : left;
        theta += omega * span + 0.5 * a * span * span;
        omega = stops ? Jet(0.0) : omega + a * span;
        left -= span;
      }
    }
    CHECK(std::abs(s.rows.back().state[0] - theta.a) <= 1e-9);
    CHECK(std::abs(s.rows.back().state_by(0, 0) - theta.v[0]) <= 1e-8);
    CHECK(std::abs(s.rows.back().state_by(1, 0) - omega.v[0]) <= 1e-8);
  }
}

TEST_CASE("a parameter that the drive has not is refused by name") {
  const auto drive = flywheel({}, 0.0);
  REQUIRE_THROWS_WITH(parameter(drive, "gear_viscous", "coefficient"),
                      "the drive has no continuous parameter 'coefficient' in 'gear_viscous'; an effect has to be on");
}

}  // namespace wormdrive::test::events_sensitivity_closed_forms
