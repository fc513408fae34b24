#include <fmt/format.h>

#include "catch.hpp"
#include "cli/program.hpp"
#include "scenarios/lanes.hpp"
#include "simulation/lanes/lane_run.hpp"
#include "simulation/load_scenario.hpp"

// Runs whose equations are on tapes, in the lanes of one register: each gets the bits that it gets alone.

namespace wormdrive::test::scenarios_taped_lanes {

namespace {

/// Loads and effects whose steps have no closed form, with numbers in which trials differ by a factor of about 1.
std::vector<std::vector<std::string>> terms(double x) {
  return {
      {fmt::format("load={{kind=\"sinusoid\",amplitude_Nm={},frequency_Hz=2,phase_deg=17}}", 0.02 * x),
       fmt::format("load=[{{kind=\"gravity_arm\",torque_Nm={},angle_offset_deg=1}},"
                   "{{kind=\"sinusoid\",amplitude_Nm={},frequency_Hz=40,phase_deg=-90}},"
                   "{{kind=\"ramp\",rate_Nm_per_s=1e-3}}]",
                   0.0196 * x, 2e-3 * x),
       fmt::format("load=[{{kind=\"angle_table\",angles_deg=[-20,-5,0,5,20],torques_Nm=[0.02,{0},{1},{0},0.02]}},"
                   "{{kind=\"step\",torque_Nm=1e-3,time_s=0.31}}]",
                   0.019 * x, 0.017 * x)},
      {fmt::format("effect.load_spring={{stiffness_Nm_per_rad={},angle_deg=3}}", 0.05 * x)},
      {fmt::format("effect.position_friction={{amplitude={},phase_deg=20}}", 0.1 * x)},
      {fmt::format("effect.friction_drift={{share={},time_s=0.4}}", 0.1 * x)},
      {fmt::format("effect.cogging={{amplitude_Nm={},periods=4,phase_deg=0}}", 5e-4 * x),
       fmt::format("effect.cogging={{amplitude_Nm={},periods=20,phase_deg=50}}", 2e-4 * x)},
      {fmt::format("effect.transmission_error={{amplitude_deg={},phase_deg=10}}", 0.03 * x)},
      {fmt::format("effect.actuator_lag.time_constant_s={}", 4e-4 * x),
       fmt::format("effect.actuator_lag.time_constant_s={}", 3e-3 * x),
       fmt::format("effect.actuator_lag.time_constant_s={}", 2e-5 * x),
       fmt::format("effect.encoder_delay.delay_s={}", 4e-4 * x), "effect.encoder_delay.delay_s=9.99e-4"},
      {fmt::format("effect.agma.scale={}", x), fmt::format("effect.stribeck={{drop={},speed_m_per_s=0.1}}", 0.05 * x)},
      {fmt::format("effect.gear_viscous.coefficient_Nms_per_rad={}", 1e-3 * x)},
      {fmt::format("effect.worm_coulomb.torque_Nm={}", 1e-4 * x)},
      {fmt::format("effect.torque_saturation.limit_Nm={}", 0.05 * x)},
      {fmt::format("effect.encoder_scale.share={}", 0.003 * x)},
      {"sensor.counts=20000"},
      {"sensor.noise_deg=0.002"},
      {"disturbance.deviation_Nm=2e-4"},
      {"controller.delay_samples=1"}};
}

}  // namespace

TEST_CASE("lanes: trials whose equations are on tapes have the bits of runs alone, events included") {
  std::mt19937_64 random(19);
  const auto below = [&](std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random); };
  std::vector<Scenario> scenarios;
  for (int batch = 0; batch < 24; ++batch) {
    // trials of one sweep: the same terms in other strengths
    std::vector<std::pair<std::size_t, std::size_t>> on;
    const auto all = terms(1.0);
    for (std::size_t k = 0; k < all.size(); ++k)
      if (const auto first = static_cast<std::size_t>(batch % 8);  // a lag alone has a closed form
          below(4) == 0 || (k < 8 && k == first) || (k == 2 && first == 6))
        on.emplace_back(k, below(all[k].size()));
    if (batch % 8 == 7) {  // points of a table before and behind the angle that the next sample sees
      std::erase_if(on, [](const auto& term) { return term.first == 6 || term.first == 7; });
      on.insert(on.end(), {{6, 3}, {7, 0}});
    }
    const char* const law = batch % 3 == 0 ? "fig10_pid_014rad_bare.toml" : "fig10_sliding_014rad_bare.toml";
    const bool tight = below(3) == 0;
    for (int trial = 0; trial < 5; ++trial) {
      const auto here = terms(0.9 + 0.05 * trial);
      std::vector<std::string> changes{"run.solver=taylor", "run.duration_s=0.6", "metrics.from_s=0",
                                       tight ? "run.relative_tolerance=1e-12" : "run.relative_tolerance=1e-8"};
      for (const auto& [k, choice] : on) changes.push_back(here[k][choice]);
      scenarios.push_back(varied(load_scenario(shipped(law), changes, Purpose::run), random, 0.1));
    }
  }
  long taped = 0;
  for (const Scenario& scenario : scenarios) {
    const auto run = lane_run(scenario);
    taped += run && run->tape() != nullptr;
  }
  REQUIRE(taped == 120);
  require_the_same(scenarios);
}

}  // namespace wormdrive::test::scenarios_taped_lanes
