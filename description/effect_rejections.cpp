#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/elastic/elastic_teeth.hpp"
#include "description/build.hpp"
#include "description/keys.hpp"
#include "description/rejection.hpp"

namespace wormdrive {
namespace {

// What the bounds of an effect's fields cannot say; empty if nothing speaks against it.

template <class Effect>
std::string refusal(const Effect&, const Scenario&) {
  return "";
}

/// An effect that takes off more inertia than there is beside it [kg m^2, or kg].
std::string too_little(const std::string& where, double beside, double effect, Axis axis) {
  if (effect >= 0.0 || beside + effect > 0.0) return "";
  const Spelling s = spellings("inertia", unit::kilogram_square_metre, axis).front();
  return fmt::format("leaves no {} {}: {:.6g} + {:.6g} {}", in_words_of(axis, "inertia"), where, beside, effect,
                     s.unit.symbol);
}
/// What moves on the gear side beside an effect, the load's own inertia included; without teeth it moves with the rest.
template <class Effect>
std::string too_little_on_the_gear(const Effect& effect, Scenario scenario) {
  std::get<std::optional<Effect>>(scenario.effects.list).reset();
  const std::string where = stated_mesh(scenario).has_teeth ? "on the gear side" : "that moves";
  return too_little(where, total_gear_inertia(scenario), effect.inertia, scenario.axis);
}
std::string refusal(const WormInertia<double>& effect, const Scenario& scenario) {
  const GearMesh<double> mesh = stated_mesh(scenario);
  return mesh.has_teeth ? too_little("on the worm side", mesh.Jw, effect.inertia, scenario.axis)
                        : too_little_on_the_gear(effect, scenario);
}
std::string refusal(const GearInertia<double>& effect, const Scenario& scenario) {
  return too_little_on_the_gear(effect, scenario);
}

/// Dry friction that drives has no state of rest; viscous friction that drives has, see warnings().
std::string refusal(const BearingAsymmetry<double>& effect, const Scenario& scenario) {
  const auto& dry = std::get<std::optional<WormCoulomb<double>>>(scenario.effects.list);
  if (std::abs(effect.torque) <= (dry ? dry->torque : 0.0)) return "";
  return "has a torque greater than the dry friction it belongs to, worm_coulomb: it would drive the worm";
}
std::string refusal(const ToothCompliance<double>& teeth, const Scenario&) {
  if (teeth.growing_damping && teeth.limited_damping)
    return "states damping_s_per_m along with damping_Ns_per_m; keep one, the law of Hunt and Crossley or the limited "
           "damper";
  if (!teeth.growing_damping && !teeth.limited_damping)
    return "states no damping; add damping_s_per_m (law of Hunt and Crossley) or damping_Ns_per_m (limited damper), 0 "
           "for none";
  return "";
}
/// The gap is less than the pitch of the gear's teeth, which is largest for a worm with one start: 2 pi / i.
std::string refusal(const Backlash<double>& backlash, const Scenario& scenario) {
  if (!has_elastic_teeth(scenario.effects))
    return "needs elastic teeth; add [effect.tooth_compliance] with stiffness_N_per_m and "
           "damping_s_per_m";
  if (const double pitch = 2.0 * std::numbers::pi / stated_mesh(scenario).i; backlash.gap >= pitch)
    return fmt::format(
        "has a gap of {:.6g} deg, which must be less than the pitch of the gear's teeth, {:.6g} deg (360 "
        "deg / ratio)",
        backlash.gap / unit::degree, pitch / unit::degree);
  return "";
}

std::string refusal(const DcMotor<double>& motor, const Scenario&) {
  if (motor.current_bandwidth && motor.amplifier_gain)
    return "states both amplifier_gain_V_per_Nm and current_bandwidth_Hz: the amplifier gives a voltage or controls "
           "the current; leave out one of them";
  if (motor.current_bandwidth && !motor.has_inductance())
    return "states current_bandwidth_Hz without inductance_H, against which the loop changes the current; add it";
  if (motor.current_bandwidth && motor.limiter_bandwidth)
    return "states both current_bandwidth_Hz and limiter_bandwidth_Hz: a loop that controls the current keeps its "
           "limit by itself; leave out one of them";
  if (motor.limiter_bandwidth && !motor.current_limit)
    return "states limiter_bandwidth_Hz without current_limit_A, at which the limiter acts; add it";
  if (motor.current_limit && !motor.current_bandwidth && !motor.limiter_bandwidth)
    return "states current_limit_A, but not how fast the amplifier keeps to it; add current_bandwidth_Hz, if it "
           "controls the current, or limiter_bandwidth_Hz, if it gives a voltage";
  if (motor.limiter_bandwidth && !motor.has_inductance())
    return "states limiter_bandwidth_Hz without inductance_H, against which the limiter changes the current; add it";
  if (!motor.heat_capacity && (motor.thermal_resistance || motor.temperature_coefficient))
    return fmt::format("states {} without heat_capacity_J_per_K, which says how fast the winding warms up; add it",
                       motor.thermal_resistance ? "thermal_resistance_K_per_W" : "temperature_coefficient_per_K");
  return "";
}

std::string refusal(const GearboxHeat<double>& heat, const Scenario&) {
  if (heat.thermal_resistance && !heat.heat_capacity)
    return "states thermal_resistance_K_per_W without heat_capacity_J_per_K, which says how fast the gearbox warms up; "
           "add it";
  if (heat.churning_decay > 0.0 && heat.churning == 0.0)
    return "states churning_decay_per_K without churning_Nms_per_rad, which falls by it; add it, or leave out both";
  return "";
}

std::string refusal(const WormLuGre<double>& friction, const Scenario&) {
  if (friction.static_torque.has_value() != friction.stribeck_speed.has_value())
    return fmt::format("states {} without {}; add it, or leave out both",
                       friction.static_torque ? "static_torque_Nm" : "stribeck_speed_rad_per_s",
                       friction.static_torque ? "stribeck_speed_rad_per_s, the speed by which it falls"
                                              : "static_torque_Nm, from which friction falls");
  if (friction.damping && !friction.stiffness)
    return "states damping_Nms_per_rad without stiffness_Nm_per_rad, which says how far the bristles bend; add it";
  return "";
}

std::string refusal(const MeshLuGre<double>&, const Scenario& scenario) {
  if (make_mesh(scenario, Motion::forward).mu > 0.0) return "";
  return "needs friction under which its bristles slide, but mesh.friction is 0";
}

std::string refusal(const HardStops<double>& stops, const Scenario& scenario) {
  const Spelling low = spellings("angle_low", unit::degrees, scenario.axis).front(),
                 high = spellings("angle_high", unit::degrees, scenario.axis).front();
  if (!stops.low && !stops.high) return fmt::format("states neither {} nor {}; add either or both", low.key, high.key);
  const auto told = [](double angle, const Spelling& s) {
    return fmt::format("{:.6g} {}", angle / s.unit.si, s.unit.symbol);
  };
  if (stops.low && stops.high && *stops.low >= *stops.high)
    return fmt::format("has {} = {}, which must be less than {} = {}", low.key, told(*stops.low, low), high.key,
                       told(*stops.high, high));
  const double start = scenario.initial.theta_g;
  if ((stops.low && start < *stops.low) || (stops.high && start > *stops.high))
    return fmt::format("leaves out the start, {}: it must lie between the stops", told(start, low));
  return "";
}

std::string refusal(const LoadCrank<double>& crank, const Scenario& scenario) {
  if (scenario.axis == Axis::linear) return "needs a gear that turns, but the axis is linear";
  const double shortest = LoadCrank<double>::shortest_rod * crank.crank;
  if (!crank.rod || *crank.rod >= shortest) return "";
  return fmt::format("has a rod of {:.6g} m, which must be at least {} times as long as the crank, {:.6g} m",
                     *crank.rod, LoadCrank<double>::shortest_rod, shortest);
}

std::string refusal(const LoadFourBar<double>& linkage, const Scenario& scenario) {
  if (scenario.axis == Axis::linear) return "needs a gear that turns, but the axis is linear";
  const double least = LoadFourBar<double>::least_clearance * linkage.crank, clearance = linkage.clearance();
  if (clearance >= least) return "";
  const double longest_way = linkage.crank + linkage.base, reach = linkage.coupler + linkage.rocker;
  if (longest_way + least > reach)
    return fmt::format(
        "has a crank that does not come round: crank_m + base_m = {:.6g} m must be less than coupler_m + rocker_m = "
        "{:.6g} m by at least {} times the crank",
        longest_way, reach, LoadFourBar<double>::least_clearance);
  return fmt::format(
      "has a crank that does not come round: |crank_m - base_m| = {:.6g} m must be more than |coupler_m - rocker_m| = "
      "{:.6g} m by at least {} times the crank",
      std::abs(linkage.crank - linkage.base), std::abs(linkage.coupler - linkage.rocker),
      LoadFourBar<double>::least_clearance);
}

std::string refusal(const LoadCoupling<double>& coupling, const Scenario&) {
  if (!coupling.damping || coupling.stiffness) return "";
  return "states a damping without a stiffness, and a coupling twists only with one; add it, or leave out both";
}

/// Why an effect cannot be on along with another one that is; empty if it can.
template <class Effect>
std::string conflict(const Effects<double>& on) {
  std::string why;
  if constexpr (requires { Effect::excludes; })
    on.for_each([&]<class Other>(const std::optional<Other>& other) {
      for (const Exclusion& exclusion : Effect::excludes)
        if (other && Other::id == exclusion.id)
          why = fmt::format("excludes effect.{}: {}; keep one of them", exclusion.id, exclusion.why);
    });
  return why;
}

template <class Effect>
std::string why_not(const Effect& effect, const Scenario& scenario) {
  if (Effect::place == Place::mesh && !stated_mesh(scenario).has_teeth) return "needs teeth, but mesh.kind is \"none\"";
  std::string refused = refusal(effect, scenario);
  if constexpr (MayHaveStates<Effect>)
    if (refused.empty() && has_states(effect) && has_elastic_teeth(scenario.effects))
      refused = fmt::format("has states, which elastic teeth do not carry; {}, or switch effect.tooth_compliance off",
                            Effect::without_states);
  return refused.empty() ? conflict<Effect>(scenario.effects) : refused;
}

}  // namespace

std::vector<EffectRejection> effect_rejections(const Scenario& scenario) {
  std::vector<EffectRejection> list;
  scenario.effects.for_each([&]<class Effect>(const std::optional<Effect>& effect) {
    if (!effect) return;
    if (const std::string why = why_not(*effect, scenario); !why.empty())
      list.push_back({std::string(Effect::id), fmt::format("effect.{} {}", Effect::id, why)});
  });
  return list;
}

}  // namespace wormdrive
