#include <algorithm>
#include <cmath>
#include <vector>

#include "catch.hpp"
#include "cli/program.hpp"
#include "control/closed_loop.hpp"
#include "control/controller.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/run_scenario.hpp"
#include "support.hpp"

// What the integrals of the controllers do while the actuator limits the torque.

namespace wormdrive::test::control_anti_windup {

namespace {

const GearMesh<double> mesh(table1());
const NominalModel nominal{mesh.C1(), mesh.C2(), mesh.Jw * 60, mesh.Jg, 0.0196, 0.0, 0.0};
const PidParameters weights{.integral_weight = 2.3456e6};
const SlidingParameters sliding{.lambda_c = 94.2, .Phi = 0.3, .eta = 30.0};
constexpr double T = 1e-3;

/// The scenario of fig. 10 with a step of 0.5 rad in place of the sinusoid.
Scenario step_of(const std::string& law, const std::string& method, double limit) {
  std::vector<std::string> set{"reference={kind=\"step\",angle_rad=0.5,time_s=0.1}", "run.duration_s=3",
                               "run.solver=taylor", "metrics.from_s=0"};
  if (!method.empty()) set.push_back("controller.anti_windup=" + method);
  if (std::isfinite(limit)) set.push_back("effect.torque_saturation.limit_Nm=" + std::to_string(limit));
  return load_scenario(shipped("fig10_" + law + "_014rad_bare.toml"), set, Purpose::run);
}

struct Response {
  double overshoot, late_peak_to_peak, late_error;  ///< [rad]; late: in the last half second
};
Response response(const Scenario& scenario) {
  double highest = 0.0, late_low = 1e9, late_high = -1e9;
  run_scenario(scenario, {.samples = [&](const std::vector<ControlRecord>& records) {
                 for (const ControlRecord& r : records) {
                   highest = std::max(highest, r.gear_angle);
                   if (r.measured.t < 2.5) continue;
                   late_low = std::min(late_low, r.gear_angle);
                   late_high = std::max(late_high, r.gear_angle);
                 }
               }});
  return {highest - 0.5, late_high - late_low, std::max(std::abs(late_low - 0.5), std::abs(late_high - 0.5))};
}

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("back-calculation of the PID moves the integral by the excess over Ki, in its time constant") {
  const double M = mean_inertia(nominal), time = 4e-3;
  const PidGains g = lqr_gains(weights, M);
  PidController law(weights, nominal), held(weights, nominal);
  REQUIRE(close(law.tracking_time(), std::sqrt(g.Kd / g.Ki), 1e-14));
  held.prevent_windup({AntiWindup::back_calculation, time});
  const ReferencePoint goal{0.5, 0.0, 0.0};
  const double first = held({0.0, 0.0, 0.3, 0.0, goal}).torque;
  REQUIRE(first == law({0.0, 0.0, 0.3, 0.0, goal}).torque);
  const double free = law({T, 0.01, 0.3, T, goal, first, 0.1}).torque;
  const double back = held({T, 0.01, 0.3, T, goal, 0.1, 0.1}).torque;
  // I' = e + (decided - applied)/(Ki Tt)
  REQUIRE(close(free - back, (first - 0.1) * T / time, 1e-12));
  // a law that was not limited is the same to the last bit
  PidController never(weights, nominal);
  never.prevent_windup({AntiWindup::back_calculation, time});
  PidController plain(weights, nominal);
  double decided = 0.0;
  for (int k = 0; k < 50; ++k) {
    const Measurement m{k * T, 0.01 * k, 0.3, k == 0 ? 0.0 : T, goal, decided};
    decided = never(m).torque;
    REQUIRE(decided == plain(m).torque);
  }
}

TEST_CASE("conditional integration waits while the error would ask for more of what is cut, and only then") {
  for (const double e : {0.2, -0.2}) {
    const ReferencePoint goal{};
    const auto third_torque = [&](AntiWindup method, double applied) {
      PidController law(weights, nominal);
      law.prevent_windup({method, 1.0});
      law({0.0, e, 0.0, 0.0, goal});
      return law({T, e, 0.3, T, goal, applied}).torque;
    };
    PidController first(weights, nominal);
    const double asked = first({0.0, e, 0.0, 0.0, goal}).torque;
    const PidGains g = lqr_gains(weights, mean_inertia(nominal));
    const double plain = third_torque(AntiWindup::none, asked);
    REQUIRE(third_torque(AntiWindup::conditional, asked) == plain);
    // cut towards 0: the error goes on to ask for more, and the integral waits
    REQUIRE(close(third_torque(AntiWindup::conditional, 0.1 * asked) - plain, g.Ki * e * T, 1e-9));
    // cut on the other side: the error unwinds
    REQUIRE(third_torque(AntiWindup::conditional, 2.0 * asked) == plain);
  }
}

TEST_CASE("back-calculation of the sliding law within one sample leads to the torque that was applied") {
  SlidingController law(sliding, nominal, {});
  law.prevent_windup({AntiWindup::back_calculation, T});
  REQUIRE(close(law.tracking_time(), 1.0 / 94.2, 1e-14));
  const ReferencePoint goal{0.1, 0.0, 0.0};
  // no error, so that the sum itself stands still; s = e' is within the layer, as is the s of what is applied
  const Measurement first{0.0, 0.1, 0.2, 0.0, goal};
  const double asked = law(first).torque;
  for (const double share : {0.9, 0.6}) {
    Measurement next{T, 0.1, 0.2, T, goal, share * asked, 0.1};
    SlidingController again = law;
    REQUIRE(close(again(next).torque, share * asked, 1e-12));
    next.applied = asked;
    SlidingController free = law;
    REQUIRE(free(next).torque == asked);
  }
  // where no s within the layer asks for as little, the integral moves to its edge
  Measurement far{T, 0.1, 0.2, T, goal, asked + 100.0, 0.1};
  SlidingController edge = law;
  REQUIRE(close(edge(far).s, -0.3, 1e-12));
}

TEST_CASE("model recovery: behind a limit the law sees, sample for sample, the drive as it moves without one") {
  // a free inertia that the law knows, so that its model of what is missing is exact
  const double J = 1.5e-3, goal = 0.5;
  const NominalModel exact{1.0, 1.0, 0.0, J, 0.0, 0.0, 0.0};
  const auto seen_with = [&](double limit) {
    std::vector<double> seen, angles;
    PidController pid(weights, exact);
    ModelRecovery recovery(exact, pid.tracking_time());
    const auto control = [&](const Measurement& m) {
      return recovery(
          [&](const Measurement& shown) {
            seen.push_back(shown.angle);
            return pid(shown);
          },
          m);
    };
    SensorSettings sensor;
    sensor.exact_speed = true;
    Effects<double> on;
    if (std::isfinite(limit)) on = effects(TorqueSaturation<double>{limit});
    ClosedLoop loop(control, Reference{{StepReference{goal, 0.0}}}, sensor, SamplingSettings{.period = T},
                    DisturbanceSettings{}, [&](const ControlRecord& r) { angles.push_back(r.gear_angle); });
    run(WormDrive<double, TimedLoad>(GearMesh<double>::without_teeth(J), make_load(Signal{}), on, {}),
        Timetable(0.0, 1.0, 0.5, {T, 0.0}), {0.0, {0.0, 0.0}, {}}, tight(taylor), loop);
    return std::pair(seen, angles);
  };
  const auto [free, free_angles] = seen_with(infinity);
  const auto [limited, angles] = seen_with(0.1);
  REQUIRE(free == free_angles);
  REQUIRE(free.size() == 1000);
  double apart = 0.0;
  for (std::size_t k = 0; k < free.size(); ++k) {
    REQUIRE(std::abs(limited[k] - free[k]) <= 1e-9);
    apart = std::max(apart, std::abs(angles[k] - free[k]));
  }
  REQUIRE(apart > 0.4);
  REQUIRE(std::abs(angles.back() - goal) <= 1e-9);
}

TEST_CASE("model recovery faster than the samples is as fast as they are") {
  const auto torques = [](double tracking_time) {
    ModelRecovery recovery(nominal, tracking_time);
    std::vector<double> list;
    for (int k = 0; k < 50; ++k) {
      const auto law = [k](const Measurement&) { return ControlSignals{.torque = k < 20 ? 0.3 : 0.0}; };
      list.push_back(
          recovery(law, {T * k, 0.1, 0.2, k == 0 ? 0.0 : T, {0.1, 0.0, 0.0}, k > 0 && k < 20 ? 0.1 : 0.0, 0.1}).torque);
    }
    return list;
  };
  const auto as_samples = torques(T);
  REQUIRE(torques(0.01 * T) == as_samples);
  REQUIRE(torques(2.0 * T) != as_samples);
}

TEST_CASE("after a step at a limit of 0.1 N m loops wind up, and end at rest with every method against it") {
  for (const std::string law : {"pid", "sliding"}) {
    const Response free = response(step_of(law, "", infinity));
    const Response wound = response(step_of(law, "", 0.1));
    CAPTURE(law, free.overshoot, wound.late_peak_to_peak);
    REQUIRE(free.late_error < 1e-3);
    REQUIRE(wound.late_peak_to_peak > 20.0);
    for (const std::string method : {"back_calculation", "conditional", "model_recovery"}) {
      const Response limited = response(step_of(law, method, 0.1));
      CAPTURE(method, limited.overshoot, limited.late_peak_to_peak, limited.late_error);
      CHECK(limited.late_error < 5e-3);
      CHECK(limited.late_peak_to_peak < 1e-3);
      if (method == "model_recovery") CHECK(limited.overshoot <= 1.05 * free.overshoot);
    }
  }
}

TEST_CASE("without a limit that is reached every method leaves the run as it is, to the last bit") {
  for (const std::string law : {"pid", "sliding"}) {
    const auto angles = [&](const std::string& method) {
      std::vector<double> list;
      Scenario scenario = step_of(law, method, 1e3);
      scenario.run.duration = 0.5;
      run_scenario(scenario, {.samples = [&](const std::vector<ControlRecord>& records) {
                     for (const ControlRecord& r : records) list.insert(list.end(), {r.gear_angle, r.applied});
                   }});
      return list;
    };
    const auto plain = angles("none");
    REQUIRE(plain.size() > 900);
    for (const std::string method : {"back_calculation", "conditional", "model_recovery"})
      REQUIRE(angles(method) == plain);
  }
}

}  // namespace wormdrive::test::control_anti_windup
