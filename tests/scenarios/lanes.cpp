#include "scenarios/lanes.hpp"

#include <cmath>

#include <fmt/format.h>

#include "catch.hpp"
#include "cli/program.hpp"
#include "simulation/lanes/lane_run.hpp"
#include "simulation/load_scenario.hpp"

// Several closed-loop runs in the lanes of one register: each gets the bits that it gets alone.

namespace wormdrive::test::scenarios_lanes {

namespace {

Scenario figure_10(std::vector<std::string> changes = {}) {
  changes.insert(changes.begin(), {"run.solver=taylor", "run.duration_s=2", "run.relative_tolerance=1e-8"});
  return load_scenario(shipped("fig10_sliding_014rad_bare.toml"), changes, Purpose::run);
}

}  // namespace

TEST_CASE("lanes: trials of fig. 10 with random numbers have the bits of runs alone, events included") {
  std::mt19937_64 random(10);
  std::vector<Scenario> scenarios;
  for (int k = 0; k < 21; ++k) scenarios.push_back(varied(figure_10(), random, 0.2));  // 16 and a rest
  long events = 0;
  for (const BatchResult& result : run_batch(scenarios)) events += std::get<RunSummary>(result).total_events();
  REQUIRE(events > 21 * 8);
  require_the_same(scenarios);
}

TEST_CASE("lanes: the same with reports on and between samples, a late start, a window, a tighter solver") {
  std::mt19937_64 random(11);
  std::vector<Scenario> scenarios;
  for (const char* tolerance : {"run.relative_tolerance=1e-10", "run.relative_tolerance=1e-12"})
    for (int k = 0; k < 4; ++k)
      scenarios.push_back(
          varied(figure_10({tolerance, "run.report_interval_s=0.0017", "controller.sample_offset_s=0.0123",
                            "metrics.from_s=0.4", "metrics.to_s=1.7", "controller.sample_time_s=0.0021"}),
                 random, 0.1));
  require_the_same(scenarios);
}

TEST_CASE("lanes: the same far from the horizontal, at rest, and where Lemma 1 is broken") {
  std::mt19937_64 random(12);
  std::vector<Scenario> scenarios;
  for (int k = 0; k < 8; ++k) {
    Scenario scenario = figure_10({"reference.amplitude_rad=1.7", "reference.frequency_Hz=0.7", "metrics.from_s=0"});
    if (k % 4 == 1) scenario.initial.theta_g = 40.0;
    if (k % 4 == 2) {  // too weak to move for most of the time
      std::get<SinusoidReference>(scenario.control->reference.terms.front()).amplitude = 0.01;
      auto& law = std::get<SlidingParameters>(scenario.control->law);
      law.Phi = 50.0;
      law.eta = 0.01;
      scenario.control->nominal.load_torque = 0.0;
    }
    if (k % 4 == 3) std::get<GravityArm>(scenario.load).amplitude = 0.4;
    scenarios.push_back(varied(scenario, random, 0.2));
  }
  long broken = 0;
  double stuck = 0.0;
  for (const Scenario& scenario : scenarios) {
    const ControlSummary run = *run_scenario(scenario).control;
    broken += !run.lemma->clean();
    stuck += run.metrics.time_stuck;
  }
  REQUIRE(broken > 0);
  REQUIRE(stuck > 0.0);
  require_the_same(scenarios);
}

TEST_CASE(
    "lanes: the same with a motor of another gain, offset and limit, and friction that depends on the direction") {
  std::mt19937_64 random(15);
  std::vector<Scenario> scenarios;
  for (const char* effect :
       {"effect.torque_gain.share=0.1", "effect.torque_offset.torque_Nm=1e-3", "effect.torque_saturation.limit_Nm=0.03",
        "effect.friction_asymmetry.change=0.02", "effect.static_friction.rise=0.02"})
    for (const char* other : {"effect.worm_coulomb.torque_Nm=1e-4", "effect.torque_gain.share=-0.05"})
      scenarios.push_back(varied(figure_10({effect, other, "metrics.from_s=0"}), random, 0.2));
  require_the_same(scenarios);
}

TEST_CASE("lanes: the same where a motor's limit is reached, whatever keeps the integral from winding up") {
  std::mt19937_64 random(16);
  std::vector<Scenario> scenarios;
  const auto [anti_windup] = AntiWindupSettings::choices();
  for (const std::string_view method : anti_windup.words)
    for (const char* law : {"fig10_sliding_014rad_bare.toml", "fig10_pid_014rad_bare.toml"})
      scenarios.push_back(
          varied(load_scenario(shipped(law),
                               {{"run.solver=taylor", "run.duration_s=1", "effect.torque_saturation.limit_Nm=0.012",
                                 "metrics.from_s=0", fmt::format("controller.anti_windup={}", method)}},
                               Purpose::run),
                 random, 0.2));
  require_the_same(scenarios);
}

TEST_CASE("lanes: the same whatever law, load, bearings, encoder, motor and delay lie between angle and torque") {
  std::mt19937_64 random(17);
  const auto one_of = [&](const std::vector<std::string>& choices) {
    return choices[std::uniform_int_distribution<std::size_t>(0, choices.size() - 1)(random)];
  };
  std::vector<Scenario> scenarios;
  for (int k = 0; k < 96; ++k) {
    std::vector<std::string> changes{"run.solver=taylor", "run.duration_s=0.7", "metrics.from_s=0"};
    const std::vector<std::string> none{"run.relative_tolerance=1e-8"};
    for (const std::vector<std::string>& choices : std::vector<std::vector<std::string>>{
             {none.front(), "load={kind=\"constant\",torque_Nm=0.015}", "load={kind=\"constant\",torque_Nm=-0.2}"},
             {none.front(), "effect.worm_viscous.coefficient_Nms_per_rad=1e-6",
              "effect.gear_viscous.coefficient_Nms_per_rad=1e-3"},
             {none.front(), "effect.encoder_scale.share=0.003"},
             {none.front(), "effect.encoder_offset.angle_deg=-0.02"},
             {none.front(), "effect.torque_gain.share=0.1"},
             {none.front(), "effect.torque_saturation.limit_Nm=0.02"},
             {none.front(), "effect.worm_coulomb.torque_Nm=1e-4"},
             {none.front(), "controller.nominal.load_angle_offset_deg=3"},
             {none.front(), none.front(), "sensor.counts=20000", "sensor.counts=600", "sensor.counts=1e17"},
             {none.front(), "sensor.noise_deg=0.002"},
             {none.front(), "sensor.zero_error_deg=-0.7"},
             {none.front(), "disturbance.deviation_Nm=2e-4", "disturbance={deviation_Nm=1e-4,time_constant_s=0.01}"},
             {none.front(), "controller.delay_samples=1"},
             {none.front(), none.front(), "effect.encoder_delay.delay_s=3e-4", "effect.encoder_delay.delay_s=9.999e-4",
              "effect.encoder_delay.delay_s=1e-9", "effect.actuator_delay.delay_s=2e-4",
              "effect.actuator_delay.delay_s=9.99e-4", "effect.actuator_lag.time_constant_s=1e-6",
              "effect.actuator_lag.time_constant_s=5e-4", "effect.actuator_lag.time_constant_s=0.02"}})
      changes.push_back(one_of(choices));
    scenarios.push_back(
        varied(load_scenario(shipped(one_of({"fig10_sliding_014rad_bare.toml", "fig10_pid_014rad_bare.toml"})), changes,
                             Purpose::run),
               random, 0.2));
    REQUIRE(fits_lane(scenarios.back()));
  }
  require_the_same(scenarios);
}

TEST_CASE("lanes: the same with a motor that answers late, by another time in every trial, be it as strong as it may") {
  std::mt19937_64 random(20);
  const auto decades = [&](double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution(0.0, 1.0)(random));
  };
  for (const char* law : {"fig10_sliding_014rad_bare.toml", "fig10_pid_014rad_bare.toml"})
    for (const std::string motor : {"actuator_lag.time_constant_s={}", "actuator_delay.delay_s={}",
                                    "dc_motor={{resistance_ohm={},torque_constant_Nm_per_A=0.05}}"}) {
      std::vector<Scenario> scenarios;
      for (int k = 0; k < 16; ++k) {
        const double number = motor.starts_with("dc") ? decades(0.3, 30.0) : decades(1e-6, 9e-4);
        scenarios.push_back(varied(
            load_scenario(shipped(law),
                          {{"run.solver=taylor", "run.duration_s=0.8", "metrics.from_s=0",
                            "effect." + fmt::format(fmt::runtime(motor), number),
                            k % 2 == 0 ? "effect.torque_saturation.limit_Nm=0.04" : "effect.torque_gain.share=0.1"}},
                          Purpose::run),
            random, 0.2));
        const auto run = lane_run(scenarios.back());
        INFO(motor << " with " << number);
        REQUIRE(run);
        REQUIRE(run->tape() == nullptr);
      }
      require_the_same(scenarios);
    }
}

TEST_CASE("lanes: the same where only some of the trials are noisy, count, see late or are disturbed") {
  std::mt19937_64 random(18);
  std::vector<Scenario> scenarios;
  for (int k = 0; k < 16; ++k) {
    scenarios.push_back(varied(figure_10({"metrics.from_s=0", fmt::format("sensor.seed={}", k)}), random, 0.2));
    ControlScenario& control = *scenarios.back().control;
    if (k % 3 == 1) control.sensor.noise = 1e-4;
    if (k % 4 == 1) control.sensor.counts = 4000;
    if (k % 5 == 2) control.disturbance = {.deviation = 2e-4, .seed = 1.0 + k};
    if (k % 7 == 3) control.sensor.zero_error = 1e-3;
    if (k % 3 == 2) std::get<std::optional<EncoderDelay<double>>>(scenarios.back().effects.list).emplace(1e-4 * k);
  }
  require_the_same(scenarios);
}

TEST_CASE("lanes: scenarios that do not fit into a lane, or not with the others, run all the same") {
  std::mt19937_64 random(13);
  std::vector<Scenario> scenarios;
  for (const std::vector<std::string>& change :
       std::vector<std::vector<std::string>>{{},
                                             {"reference.frequency_Hz=2.1"},
                                             {"sensor.counts=10000"},
                                             {"sensor.zero_error_deg=0.1", "sensor.index_mark_deg=0.5"},
                                             {"effect.worm_viscous.coefficient_Nms_per_rad=1e-6"},
                                             {"effect.worm_coulomb.torque_Nm=1e-4"},
                                             {"effect.torque_saturation.limit_Nm=0.03"},
                                             {"effect.encoder_offset.angle_deg=0.01"},
                                             {"run.solver=cvode"},
                                             {"controller.delay_samples=1"},
                                             {}})
    scenarios.push_back(varied(figure_10(change), random, 0.1));
  require_the_same(scenarios);
}

TEST_CASE("lanes: a run that cannot go on fails alone, for the reason that it has alone") {
  std::mt19937_64 random(14);
  std::vector<Scenario> scenarios;
  for (int k = 0; k < 7; ++k) scenarios.push_back(varied(figure_10(), random, 0.1));
  scenarios[2].control->nominal.load_torque = 1e308;
  const auto results = run_batch(scenarios);
  for (std::size_t k = 0; k < results.size(); ++k) REQUIRE(std::holds_alternative<std::string>(results[k]) == (k == 2));
  require_the_same(scenarios);
}

TEST_CASE("lanes: nothing comes of nothing") { REQUIRE(run_batch({}).empty()); }

}  // namespace wormdrive::test::scenarios_lanes
