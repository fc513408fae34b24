#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "catch.hpp"
#include "cli/program.hpp"
#include "near_ties/dice.hpp"
#include "numbers.hpp"
#include "scenarios/lanes.hpp"
#include "simulation/lane_run.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/solver_cross_check.hpp"

// Trials in the lanes of registers, of random drives with up to five effects at once, judged by CVODE under the same
// torques: many of these loops are unstable and would amplify the last digit of either solver.

namespace wormdrive::test::scenarios_lanes_by_cvode {

namespace {

using near_ties::Dice;

/// The closed loop of fig. 10 on a scale of its own: times over four decades, inertias over six.
struct Loop {
  double T, J;  ///< multiples of the paper's times and inertias
  bool pid;
  double torque() const { return J / (T * T); }
  double drag() const { return J / T; }
};

std::vector<std::string> nominal(Dice& dice, const Loop& on) {
  const auto key = [](const char* name, double value) { return fmt::format("{}={}", name, value); };
  std::vector<std::string> words{key("mesh.friction", dice.between(0.08, 0.3)),
                                 key("mesh.lead_angle_deg", dice.between(3.0, 8.0)),
                                 key("mesh.worm_inertia_kgm2", 2.53e-5 * on.J),
                                 key("mesh.gear_inertia_kgm2", 7.39e-4 * on.J * dice.decades(0.1, 3.0)),
                                 key("load.torque_Nm", 0.0196 * on.torque() * dice.decades(0.1, 3.0)),
                                 key("load.angle_offset_deg", dice.between(-180.0, 180.0)),
                                 key("controller.sample_time_s", 1e-3 * on.T),
                                 key("controller.break_in_speed_rad_per_s", 0.005 / on.T),
                                 key("controller.nominal.load_torque_Nm", 0.0196 * on.torque()),
                                 key("reference.frequency_Hz", 2.0 / on.T * dice.decades(0.5, 2.0)),
                                 key("sensor.speed_filter_Hz", 200.0 / on.T),
                                 key("run.duration_s", 0.4 * on.T),
                                 key("run.report_interval_s", 0.013 * on.T),
                                 "run.solver=taylor",
                                 "metrics.from_s=0"};
  if (on.pid)
    words.push_back(key("controller.integral_weight", 2.3456e6 * on.torque() * on.torque() / (on.T * on.T)));
  else
    words.insert(words.end(),
                 {key("controller.bandwidth_rad_per_s", 94.0 / on.T), key("controller.layer_rad_per_s", 0.3 / on.T),
                  key("controller.eta_rad_per_s2", 30.0 / (on.T * on.T))});
  return words;
}

/// Up to five effects, loads, sensors and motors; an asymmetry comes with the friction that it belongs to.
std::vector<std::string> additions(Dice& dice, const Loop& on) {
  const double tau = on.torque() * 1e-3 * dice.decades(0.1, 10.0), resistance = dice.decades(0.1, 100.0);
  std::vector<std::string> all{
      fmt::format("load={{kind=\"constant\",torque_Nm={}}}", 20.0 * tau * dice.sign()),
      fmt::format("load={{kind=\"sinusoid\",amplitude_Nm={},frequency_Hz={}}}", 20.0 * tau,
                  dice.decades(0.5, 50.0) / on.T),
      fmt::format("load={{kind=\"angle_table\",angles_deg=[-20,-5,0,5,20],torques_Nm=[0,{0},{1},{0},0]}}", 20.0 * tau,
                  10.0 * tau),
      fmt::format("effect.load_spring={{stiffness_Nm_per_rad={},angle_deg={}}}", 50.0 * tau, dice.between(-9.0, 9.0)),
      fmt::format("effect.position_friction={{amplitude={},phase_deg={}}}", dice.between(0.02, 0.3),
                  dice.between(-180.0, 180.0)),
      fmt::format("effect.friction_drift={{share={},time_s={}}}", dice.between(-0.3, 0.3),
                  on.T * dice.decades(0.1, 10)),
      fmt::format("effect.cogging={{amplitude_Nm={},periods={},phase_deg={}}}", 0.1 * tau, 1 + dice.below(12),
                  dice.between(-180.0, 180.0)),
      fmt::format("effect.transmission_error={{amplitude_deg={},phase_deg={}}}", dice.decades(1e-3, 0.05),
                  dice.between(-180.0, 180.0)),
      fmt::format("effect.actuator_lag.time_constant_s={}", on.T * dice.decades(1e-6, 1e-2)),
      fmt::format("effect.actuator_delay.delay_s={}", on.T * dice.decades(1e-6, 9e-4)),
      fmt::format("effect.encoder_delay.delay_s={}", on.T * dice.decades(1e-6, 9e-4)),
      fmt::format("effect.dc_motor={{resistance_ohm={},torque_constant_Nm_per_A={}}}", resistance,
                  std::sqrt(resistance * 2.5e-5 * on.drag() * dice.decades(0.1, 100.0))),
      fmt::format("effect.agma.scale={}", dice.between(0.5, 1.5)),
      fmt::format("effect.stribeck={{drop={},speed_m_per_s={}}}", dice.between(0.01, 0.07),
                  0.1 * dice.decades(0.1, 10.0)),
      fmt::format("effect.worm_viscous.coefficient_Nms_per_rad={}", 1e-5 * on.drag() * dice.decades(0.01, 10.0)),
      fmt::format("effect.gear_viscous.coefficient_Nms_per_rad={}", 1e-3 * on.drag() * dice.decades(0.1, 100.0)),
      fmt::format("effect.worm_coulomb.torque_Nm={}", tau),
      fmt::format("effect.gear_coulomb.torque_Nm={}", 10.0 * tau),
      fmt::format("effect.bearing_asymmetry={{torque_Nm={},coefficient_Nms_per_rad=0}}", 0.1 * tau),
      fmt::format("effect.friction_asymmetry.change={}", dice.between(-0.03, 0.03)),
      fmt::format("effect.static_friction.rise={}", dice.between(0.0, 0.1)),
      fmt::format("effect.torque_saturation.limit_Nm={}", 0.1 * on.torque() * dice.decades(0.5, 5.0)),
      fmt::format("effect.torque_gain.share={}", dice.between(-0.2, 0.2)),
      fmt::format("effect.torque_offset.torque_Nm={}", tau * dice.sign()),
      fmt::format("effect.encoder_scale.share={}", dice.between(-0.01, 0.01)),
      fmt::format("effect.encoder_offset.angle_deg={}", dice.between(-1.0, 1.0)),
      fmt::format("sensor.counts={}", std::round(dice.decades(500, 1e6))),
      fmt::format("sensor.noise_deg={}", dice.decades(1e-5, 1e-2)),
      fmt::format("disturbance.deviation_Nm={}", 0.1 * tau),
      "controller.delay_samples=1"};
  // of what excludes each other, one
  const auto kind = [](const std::string& word) {
    const std::string table = word.substr(0, word.find('='));
    const bool law = table.starts_with("effect.agma") || table == "effect.stribeck" ||
                     table.starts_with("effect.friction_asymmetry");
    return law ? "friction" : table;
  };
  std::vector<std::string> chosen;
  for (int count = 1 + dice.below(5); count > 0; --count) {
    const std::string& word = all[static_cast<std::size_t>(dice.below(static_cast<int>(all.size())))];
    if (std::ranges::none_of(chosen, [&](const std::string& other) { return kind(other) == kind(word); }))
      chosen.push_back(word);
  }
  const auto on_it = [&](const char* table) {
    return std::ranges::any_of(chosen, [&](const std::string& word) { return word.starts_with(table); });
  };
  if (on_it("effect.bearing_asymmetry") && !on_it("effect.worm_coulomb"))
    chosen.push_back(fmt::format("effect.worm_coulomb.torque_Nm={}", tau));
  return chosen;
}

}  // namespace

TEST_CASE("lanes: 200 random drives with up to five effects are what CVODE finds, on any scale of time and size") {
  int judged = 0, in_lanes = 0;
  long events = 0;
  Deviation apart;
  for (std::uint64_t index = 0; judged < 200; ++index) {
    REQUIRE(index < 400);
    Dice dice(22, index);
    const Loop loop{dice.decades(0.01, 100.0), dice.decades(1e-3, 1e3), dice.chance(0.3)};
    std::vector<std::string> words = nominal(dice, loop);
    const std::vector<std::string> further = additions(dice, loop);
    words.insert(words.end(), further.begin(), further.end());
    INFO(fmt::format("drive {}: {}", index, fmt::join(words, " ")));
    std::mt19937_64 random(index);
    std::vector<Scenario> trials;
    for (int k = 0; k < 3; ++k) {
      const char* const law = loop.pid ? "fig10_pid_014rad_bare.toml" : "fig10_sliding_014rad_bare.toml";
      trials.push_back(varied(load_scenario(shipped(law), words, Purpose::run), random, 0.02));
    }
    in_lanes += fits_lane(trials.front());
    const std::vector<BatchResult> rows = run_batch(trials);
    REQUIRE(strangers(trials, rows) == 0);
    const auto* const row = std::get_if<RunSummary>(&rows.front());
    if (!row) continue;  // a drive that jams
    ++judged;
    for (const long count : row->events) events += count;
    apart.add(cross_check(trials.front()).angle);
    REQUIRE(apart <= 1e-7);  // [rad], a tenth of what a sweep's referee asks
  }
  CAPTURE(apart, events, in_lanes);
  CHECK(in_lanes >= 180);
  CHECK(events > 4000);
}

}  // namespace wormdrive::test::scenarios_lanes_by_cvode
