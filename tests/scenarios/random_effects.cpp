#include "scenarios/random_effects.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/program.hpp"
#include "description/diagnostics.hpp"
#include "events/torque_ratio.hpp"
#include "numbers.hpp"
#include "simulation/load_scenario.hpp"
#include "support.hpp"

namespace wormdrive::test {

DrawnDrive draw_effects(near_ties::Dice& dice) {
  MeshParameters<double> p = table1(dice.between(0.05, 0.3));
  const double T = dice.decades(0.03, 30.0), tau_l = dice.decades(0.01, 1.0), break_in = torque_ratio(p, -p.mu) * tau_l,
               speed = 2.0 * std::numbers::pi / T;
  DrawnDrive drive{.period = T};
  std::vector<std::string>& words = drive.words;
  words = {
      fmt::format("mesh.friction={}", p.mu), fmt::format("run.duration_s={}", 3.0 * T),
      fmt::format("run.report_interval_s={}", T / 50.0), "run.relative_tolerance=1e-12",
      fmt::format("run.absolute_tolerance={}", 1e-14 * std::min(1.0, 1.0 / T)),
      // a worm that turns some times as fast as the input swings takes the torque
      fmt::format("effect.worm_viscous.coefficient_Nms_per_rad={}", break_in / (p.i * speed) * dice.decades(0.1, 3.0))};
  std::vector<std::string> loads{
      fmt::format("{{kind=\"gravity_arm\",torque_Nm={},angle_offset_deg={}}}", tau_l, dice.between(-180.0, 180.0))};
  double command = break_in * dice.decades(1.5, 6.0);
  int count = 0;
  const auto state = [&](double probability, const std::string& word) {
    if (!dice.chance(probability)) return false;
    words.push_back(word);
    ++count;
    return true;
  };
  while (count == 0) {
    const double electrical = T * dice.decades(1e-4, 1e-1), R = dice.decades(0.1, 10.0),
                 K = std::sqrt(R * break_in / (p.i * speed) * dice.decades(0.1, 3.0));
    if (state(0.4, fmt::format("effect.dc_motor={{resistance_ohm={},torque_constant_Nm_per_A={},inductance_H={}}}", R,
                               K, R * electrical))) {
      if (dice.chance(0.3)) words.push_back(fmt::format("effect.dc_motor.supply_voltage_V={}", R / K * command));
      if (dice.chance(0.3))  // which its losses warm by some 1 to 100 K within the run
        words.insert(words.end(), {fmt::format("effect.dc_motor.heat_capacity_J_per_K={}",
                                               R * std::pow(command / K, 2.0) * T / dice.decades(1.0, 100.0)),
                                   "effect.dc_motor.temperature_coefficient_per_K=0.004"});
      if (dice.chance(0.3))
        words.push_back(fmt::format("effect.dc_motor.current_bandwidth_Hz={}", dice.decades(0.1, 10.0) / electrical));
    }
    // bristles that slide within a share of the worm's way in a swing of the input
    const double coulomb = break_in * dice.decades(0.03, 0.5), bends = p.i * speed * T * dice.decades(1e-3, 1e-1);
    state(0.4, fmt::format("effect.worm_lugre={{coulomb_torque_Nm={},stiffness_Nm_per_rad={},damping_Nms_per_rad={}}}",
                           coulomb, coulomb / bends, coulomb / bends * T * dice.decades(1e-5, 1e-3)));
    // teeth that slide within a share of their way in a swing of the input, and do not ring for long
    const double slides = p.lw / std::cos(p.lambda) * p.i * speed * T * dice.decades(1e-3, 1e-1);
    state(0.3, fmt::format("effect.mesh_lugre={{stiffness_per_m={},damping_s_per_m={}}}", p.mu / slides,
                           p.mu / slides * T * dice.decades(1e-4, 1e-2)));
    const double brake = break_in * dice.decades(0.1, 3.0), opens = T * dice.between(0.1, 1.0);
    if (state(0.3, fmt::format("effect.holding_brake={{torque_Nm={},opens_s={},closes_s={}}}", brake, opens,
                               T * dice.between(1.5, 2.5)))) {
      drive.numbers.push_back({"effect.holding_brake.torque_Nm", brake});
      drive.numbers.push_back({"effect.holding_brake.opens_s", opens});
    }
    // a gearbox that its losses warm by some 1 to 100 K within the run
    state(0.4, fmt::format("effect.gearbox_heat={{friction_decay_per_K={},heat_capacity_J_per_K={},"
                           "thermal_resistance_K_per_W={},starting_rise_K={}}}",
                           dice.decades(1e-3, 1e-2), break_in * p.i * speed * T / dice.decades(1.0, 100.0),
                           dice.decades(1.0, 100.0) / (break_in * p.i * speed), dice.between(0.0, 30.0)));
    state(0.3, fmt::format("effect.friction_under_load.share={}", dice.between(0.0, 0.4)));
    // so much that the arm, as a pendulum, swings some twenty times at most while the input does it once
    const double J2 = std::max(p.Jg * dice.decades(0.1, 30.0), tau_l * std::pow(T / 125.0, 2.0)),
                 natural =
                     std::max(dice.decades(2.0, 100.0) / T, std::sqrt(3.0 * tau_l / J2));  // the arm stays upright
    state(0.5, fmt::format("effect.load_coupling={{inertia_kgm2={},stiffness_Nm_per_rad={},damping_Nms_per_rad={}}}",
                           J2, J2 * natural * natural, J2 * natural * dice.decades(0.01, 1.0)));
    const double crank = dice.decades(0.01, 0.3);
    state(0.4, fmt::format("effect.load_crank={{mass_kg={},crank_m={},rod_m={},angle_deg={}}}",
                           p.Jg * dice.decades(0.1, 3.0) / (crank * crank), crank, crank * dice.decades(1.3, 10.0),
                           dice.between(0.0, 360.0)));
    const double low = -dice.decades(2.0, 100.0), high = dice.decades(2.0, 100.0);
    if (state(0.3, fmt::format("effect.hard_stops={{angle_low_deg={},angle_high_deg={}}}", low, high))) {
      drive.numbers.push_back({"effect.hard_stops.angle_low_deg", low});
      drive.numbers.push_back({"effect.hard_stops.angle_high_deg", high});
    }
    if (dice.chance(0.3)) {
      loads.push_back(fmt::format("{{kind=\"fan\",torque_Nm={},speed_rad_per_s={}}}", 0.3 * tau_l, speed));
      ++count;
    }
    if (dice.chance(0.3)) {
      const double stop = dice.decades(10.0, 300.0) / T;
      loads.push_back(
          fmt::format("{{kind=\"end_stops\",angle_high_deg={},stiffness_Nm_per_rad={},damping_s_per_rad={}}}",
                      dice.between(5.0, 60.0), p.Jg * stop * stop, T * dice.decades(0.01, 1.0)));
      ++count;
    }
  }
  const double phase = dice.between(-180.0, 180.0), step_time = T * dice.between(0.1, 2.5);
  std::string torque =
      fmt::format("{{kind=\"sinusoid\",amplitude_Nm={},frequency_Hz={},phase_deg={}}}", command, 1.0 / T, phase);
  words.push_back(fmt::format("load=[{}]", fmt::join(loads, ",")));
  if (dice.chance(0.3)) {
    torque += fmt::format(",{{kind=\"step\",torque_Nm={},time_s={}}}", command * dice.between(-1.0, 1.0), step_time);
    drive.numbers.push_back({"motor.torque[1].time_s", step_time});
  }
  words.push_back(fmt::format("motor.torque=[{}]", torque));
  drive.numbers.push_back({"motor.torque[0].amplitude_Nm", command});
  return drive;
}

Scenario scenario_of(const DrawnDrive& drive, const std::vector<std::string>& further) {
  std::vector<std::string> words = drive.words;
  words.insert(words.end(), further.begin(), further.end());
  return load_scenario(shipped("fig09_switching.toml"), words, Purpose::run);
}

std::optional<Scenario> unless_it_jams(const DrawnDrive& drive, const std::vector<std::string>& further) {
  try {
    return scenario_of(drive, further);
  } catch (const InputFault&) {
    return std::nullopt;
  }
}

}  // namespace wormdrive::test
