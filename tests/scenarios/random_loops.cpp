#include "scenarios/random_loops.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "support.hpp"

namespace wormdrive::test {

using near_ties::Dice;

RandomLoop draw_loop(Dice& dice) { return {dice.decades(0.01, 100.0), dice.decades(1e-3, 1e3), dice.chance(0.3)}; }

const char* law_of(const RandomLoop& on) {
  return on.pid ? "fig10_pid_014rad_bare.toml" : "fig10_sliding_014rad_bare.toml";
}

std::vector<std::string> nominal_words(Dice& dice, const RandomLoop& on) {
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

std::vector<std::string> additions(Dice& dice, const RandomLoop& on, int most) {
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
  for (int count = 1 + dice.below(most); count > 0; --count) {
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

namespace {

/// One of them, or two different ones.
std::vector<std::string> one_or_two(Dice& dice, const std::vector<std::string>& all) {
  const int first = dice.below(static_cast<int>(all.size())), second = dice.below(static_cast<int>(all.size()));
  std::vector<std::string> chosen{all[static_cast<std::size_t>(first)]};
  if (second != first) chosen.push_back(all[static_cast<std::size_t>(second)]);
  return chosen;
}

}  // namespace

std::vector<std::string> what_compares(Dice& dice, const RandomLoop& on) {
  const double tau = on.torque() * 1e-2 * dice.decades(0.1, 10.0), duration = 0.4 * on.T,
               natural = dice.decades(10.0, 300.0) / on.T;
  const std::string arm =
      fmt::format("{{kind=\"gravity_arm\",torque_Nm={},angle_offset_deg={}}}", tau, dice.between(-180.0, 180.0));
  std::string brake = fmt::format("effect.holding_brake={{torque_Nm={}", 0.1 * tau);
  if (dice.chance(0.7)) brake += fmt::format(",opens_s={}", duration * dice.between(0.0, 1.0));
  if (dice.chance(0.7)) brake += fmt::format(",closes_s={}", duration * dice.between(0.0, 1.0));
  return one_or_two(
      dice, {fmt::format("effect.friction_under_load.share={}", dice.between(0.01, 0.5)), brake + "}",
             fmt::format("load=[{},{{kind=\"end_stops\",angle_low_deg={},angle_high_deg={},stiffness_Nm_per_rad={},"
                         "damping_s_per_rad={}}}]",
                         arm, -dice.decades(2.0, 30.0), dice.decades(2.0, 30.0), 0.018 * on.J * natural * natural,
                         dice.chance(0.5) ? 0.0 : on.T * dice.decades(0.01, 1.0)),
             fmt::format("load=[{},{{kind=\"fan\",torque_Nm={},speed_rad_per_s={}}}]", arm, tau, 2.0 / on.T)});
}

std::vector<std::string> effects_with_states(Dice& dice, const RandomLoop& on) {
  const double tau = on.torque() * 1e-3 * dice.decades(0.1, 10.0), sample = 1e-3 * on.T, speed = 4.0 / on.T,
               R = dice.decades(0.1, 10.0), K = std::sqrt(R * 2.5e-5 * on.drag() * dice.decades(0.1, 10.0));
  std::string motor = fmt::format("effect.dc_motor={{resistance_ohm={},torque_constant_Nm_per_A={}", R, K);
  const bool turns_current = dice.chance(0.7);
  if (turns_current) motor += fmt::format(",inductance_H={}", R * sample * dice.decades(0.03, 30.0));
  if (!turns_current || dice.chance(0.3))  // which its losses warm by some 1 to 100 K
    motor += fmt::format(",heat_capacity_J_per_K={},temperature_coefficient_per_K=0.004",
                         R * std::pow(0.05 * on.torque() / K, 2.0) * on.T / dice.decades(1.0, 100.0));
  const bool controls_current = turns_current && dice.chance(0.5);
  if (controls_current) motor += fmt::format(",current_bandwidth_Hz={}", dice.decades(0.03, 1.0) / sample);
  if (dice.chance(0.4))
    motor += fmt::format(",supply_voltage_V={}", 0.05 * on.torque() * R / K * dice.decades(0.5, 20));
  std::string bristles = fmt::format("effect.worm_lugre={{coulomb_torque_Nm={},stiffness_Nm_per_rad={}", tau,
                                     tau / (26.0 * speed * sample * dice.decades(0.1, 100.0)));
  if (dice.chance(0.5))  // where they begin to slide it takes more
    bristles += fmt::format(",static_torque_Nm={},stribeck_speed_rad_per_s={}", tau * dice.between(1.0, 1.5),
                            26.0 * speed * dice.decades(1e-3, 1.0));
  bristles += "}";
  const double inertia = 7.39e-4 * on.J * dice.decades(0.1, 10.0), natural = dice.decades(10.0, 1000.0) / on.T;
  return one_or_two(
      dice, {motor + "}", bristles,
             fmt::format("effect.mesh_lugre={{stiffness_per_m={},damping_s_per_m={}}}", dice.decades(1e2, 1e5),
                         on.T * dice.decades(1e-3, 1e-1)),
             fmt::format("effect.gearbox_heat={{friction_decay_per_K={},heat_capacity_J_per_K={}}}",
                         dice.decades(1e-3, 1e-2), 0.02 * on.torque() / dice.decades(1.0, 100.0)),
             fmt::format("effect.load_coupling={{inertia_kgm2={},stiffness_Nm_per_rad={},damping_Nms_per_rad={}}}",
                         inertia, inertia * natural * natural, inertia * natural * dice.decades(0.01, 1.0)),
             fmt::format("effect.hard_stops={{angle_low_deg={},angle_high_deg={}}}", -dice.decades(2.0, 100.0),
                         dice.decades(2.0, 100.0))});
}

}  // namespace wormdrive::test
