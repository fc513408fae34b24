#include <cmath>
#include <limits>

#include "catch.hpp"
#include "cli/program.hpp"
#include "control/closed_loop.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/run_scenario.hpp"
#include "support.hpp"

// Controllers and sensors that misbehave: a clear error or a correct run, never a hang.

namespace wormdrive::test::control_robustness {

namespace {

/// The motor torques of a run of the fig. 9 drive under a control, at the ends of its sample intervals.
template <class Control>
std::vector<double> torques(Control control, double period, double duration, Effects<double> on = {}) {
  auto d = drive(table1(), fig9_load(), {}, std::move(on));
  CvodeSolver solver(d, tight(adams, 1e-9));
  std::vector<double> list;
  ClosedLoop loop(control, Reference{}, SensorSettings{}, SamplingSettings{period}, DisturbanceSettings{},
                  [](const ControlRecord&) {});
  simulate(d, solver, loop, Timetable(0.0, duration, std::numeric_limits<double>::infinity(), {period, 0.0}),
           typename decltype(d)::Instant{},
           [&](const auto& system, const auto& now) { list.push_back(system.observe(now).tau_m); });
  return list;
}

std::string halt_of(double torque) {
  try {
    torques([=](const Measurement& m) { return ControlSignals{.torque = m.t < 0.0025 ? 0.01 : torque}; }, 1e-3, 0.01);
    return "";
  } catch (const SimulationFailure& halt) {
    return halt.what();
  }
}

}  // namespace

TEST_CASE("a controller that returns no number stops the run with the time") {
  for (const double torque : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    const std::string words = halt_of(torque);
    INFO(words);
    REQUIRE(words.find("0.003 s") != std::string::npos);
    REQUIRE(words.find("the controller returned a torque that is no number") != std::string::npos);
  }
}

TEST_CASE("a torque beyond the limit is cut to it in the motor") {
  const auto wild = [](const Measurement& m) { return ControlSignals{.torque = m.t < 0.005 ? 1e6 : -1e6}; };
  double largest = 0.0;
  for (const double torque : torques(wild, 1e-3, 0.01, effects(TorqueSaturation<double>{.limit = 0.2})))
    largest = std::max(largest, std::abs(torque));
  REQUIRE(largest == 0.2);
}

TEST_CASE("a sample time longer than the run takes one sample and holds it") {
  int samples = 0;
  const auto counted = [&](const Measurement&) { return ++samples, ControlSignals{.torque = 0.02}; };
  REQUIRE(torques(counted, 5.0, 0.1).back() == 0.02);
  REQUIRE(samples == 1);
}

TEST_CASE("without break-in compensation, and with an encoder of 16 counts, a run comes to its end") {
  for (const char* file : {"fig10_sliding_014rad_bare.toml", "fig10_pid_014rad_bare.toml"}) {
    const std::vector<std::string> shorter{"run.duration_s=1.5"};
    std::vector<std::string> eps = shorter, coarse = shorter;
    eps.emplace_back("controller.break_in_speed_rad_per_s=0");
    coarse.emplace_back("sensor.counts=16");
    const double good =
        run_scenario(load_scenario(shipped(file), eps, Purpose::run)).control->metrics.error_peak_to_peak;
    REQUIRE((good > 0.0 && good < 1e-3));
    const RunSummary blind = run_scenario(load_scenario(shipped(file), coarse, Purpose::run));
    REQUIRE(std::isfinite(blind.end.theta_g));  // 0.39 rad a count: the reference is not seen at all
    REQUIRE(blind.control->metrics.error_max > 0.01);
  }
}

TEST_CASE("a delay of one sample, noise and a coloured disturbance make a run that repeats to the last bit") {
  const std::vector<std::string> changes{
      "run.duration_s=1.2",  "controller.delay_samples=1",    "sensor.noise_rad=1e-5",
      "sensor.counts=20000", "disturbance.deviation_Nm=1e-3", "disturbance.time_constant_s=0.01"};
  const Scenario s = load_scenario(shipped("fig10_pid_014rad_bare.toml"), changes, Purpose::run);
  const RunSummary first = run_scenario(s), again = run_scenario(s);
  REQUIRE(first.end.theta_g == again.end.theta_g);
  REQUIRE(first.control->metrics.error_rms == again.control->metrics.error_rms);
  REQUIRE(first.control->metrics.error_peak_to_peak < 5e-3);
}

}  // namespace wormdrive::test::control_robustness
