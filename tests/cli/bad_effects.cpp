// One malformed input per line:
// clang-format off
#include "cli/bad_input.hpp"

// What the program says about effects that cannot be, alone or with the drive they act on.

namespace wormdrive::test::cli_bad_effects {

namespace {

std::string with(const std::string& effect) { return good_scenario + effect; }

}  // namespace

TEST_CASE("an effect outside its limits is rejected with the limit") {
  check_rejected(Folder(), {
      {"no Stribeck speed", with("[effect.stribeck]\ndrop = 0.1\nspeed_m_per_s = 0\n"),
       "s.toml:21:17: error: effect.stribeck.speed_m_per_s = 0 m/s must be greater than 0 m/s"},
      {"half an exponent", with("[effect.stribeck]\ndrop = 0.1\nspeed_m_per_s = 0.1\nexponent = 1.5\n"),
       "s.toml:22:12: error: effect.stribeck.exponent = 1.5 must be a whole number"},
      {"half a tail", with("[effect.stribeck]\ndrop = 0.1\nspeed_m_per_s = 0.1\ntail = 0.5\n"),
       "s.toml:22:8: error: effect.stribeck.tail = 0.5 must be a whole number"},
      {"a lag of nothing", with("[effect.actuator_lag]\ntime_constant_s = 0\n"),
       "s.toml:20:19: error: effect.actuator_lag.time_constant_s = 0 s must be greater than 0 s"},
      {"a sensor that foresees", with("[effect.encoder_delay]\ndelay_s = -1e-3\n"),
       "s.toml:20:11: error: effect.encoder_delay.delay_s = -0.001 s must be at least 0 s"},
      {"a dead motor", with("[effect.torque_gain]\nshare = -1\n"),
       "s.toml:20:9: error: effect.torque_gain.share = -1 must be greater than -1"},
      {"too eccentric", with("[effect.position_friction]\namplitude = 1.1\nphase_deg = 0\n"),
       "s.toml:20:13: error: effect.position_friction.amplitude = 1.1 must be at least -1 and at most 1"}});
}

TEST_CASE("an effect that contradicts the drive is rejected with the resulting value") {
  check_rejected(Folder(), {
      {"no teeth", "[mesh]\nkind = \"none\"\ninertia_kgm2 = 1\n[run]\nduration_s = 1\n[effect.mesh_friction]\nchange = 0.1\n",
       "s.toml:6:1: error: effect.mesh_friction needs teeth, but mesh.kind is \"none\""},
      {"no worm", with("[effect.worm_inertia]\ninertia_kgm2 = -2.53e-5\n"),
       "s.toml:19:1: error: effect.worm_inertia leaves no inertia on the worm side: 2.53e-05 + -2.53e-05 kg m^2"},
      {"no gear", with("[effect.gear_inertia]\ninertia_kgm2 = -1e-3\n"),
       "s.toml:19:1: error: effect.gear_inertia leaves no inertia on the gear side: 0.000739 + -0.001 kg m^2"},
      {"a bearing that drives", with("[effect.bearing_asymmetry]\ntorque_Nm = 0.002\ncoefficient_Nms_per_rad = 0\n[effect.worm_coulomb]\ntorque_Nm = 0.001\n"),
       "s.toml:19:1: error: effect.bearing_asymmetry has a torque greater than the dry friction it belongs to, worm_coulomb: it would drive the worm"}});
}

TEST_CASE("two effects that exclude each other are rejected with the reason") {
  check_rejected(Folder(), {
      {"two curves", with("[effect.agma]\n[effect.stribeck]\ndrop = 0.1\nspeed_m_per_s = 0.1\n"),
       "s.toml:19:1: error: effect.agma excludes effect.stribeck: both say how friction falls with the sliding speed; keep one of them"},
      {"rest on elastic teeth", with("[effect.tooth_compliance]\nstiffness_N_per_m = 1e7\ndamping_s_per_m = 1\n[effect.static_friction]\nrise = 0.05\n"),
       "s.toml:22:1: error: effect.static_friction excludes effect.tooth_compliance: elastic teeth hold with the friction of sliding; keep one of them"},
      {"uneven elastic teeth", with("[effect.tooth_compliance]\nstiffness_N_per_m = 1e7\ndamping_s_per_m = 1\n[effect.transmission_error]\namplitude_deg = 0.1\nphase_deg = 0\n"),
       "s.toml:22:1: error: effect.transmission_error excludes effect.tooth_compliance: elastic teeth run at an even pitch; keep one of them"}});
}

TEST_CASE("friction whose effects carry it below zero, to mu_g or beyond eq. 17 is rejected with the value") {
  check_rejected(Folder(), {
      {"below zero", with("[effect.stribeck]\ndrop = 0.3\nspeed_m_per_s = 0.1\n"),
       "s.toml:8:12: error: mesh.friction = 0.25 may fall to -0.05 with its effects; friction must be at least 0"},
      {"drifts to mu_g", with("[effect.friction_drift]\nshare = 60\ntime_s = 0.01\n"),
       "s.toml:8:12: error: mesh.friction = 0.25, which may rise to 15.25 with its effects, is not below mu_g = 13.4382 (cos(phi_n)/tan(lambda)): the worm would lock itself; only elastic teeth, [effect.tooth_compliance], allow it"},
      {"eq. 17 by inertia", with("[effect.gear_inertia]\ninertia_kgm2 = 0.999261\n"),
       "s.toml:8:12: error: mesh.friction = 0.25 violates eq. 17, C1 > -Jw i/Jg: C1 = -0.0470643, -Jw i/Jg = -0.001518 with Jg = 1 kg m^2; *"},
      {"eq. 17 by pitch", edited(with("[effect.transmission_error]\namplitude_deg = 28\nphase_deg = 0\n"), "7.39e-4", "0.02"),
       "s.toml:8:12: error: mesh.friction = 0.25 violates eq. 17, C1 > -Jw i/Jg: C1 = -0.0470643, -Jw i k^2/Jg where the worm is slowest, k = 0.511308, = -0.019843 with Jg = 0.02 kg m^2; *"},
      {"eq. 17 by friction", edited(with("[effect.friction_asymmetry]\nchange = -0.1\n"), "7.39e-4", "0.03"),
       "s.toml:8:12: error: mesh.friction = 0.25, which may rise to 0.35 with its effects, violates eq. 17, C1 > -Jw i/Jg: C1 = *"}});
}

TEST_CASE("a motor whose current is a state is rejected with what cannot carry it") {
  const std::string motor = "[effect.dc_motor]\nresistance_ohm = 1.2\ntorque_constant_Nm_per_A = 0.025\ninductance_H = 1e-3\n";
  check_rejected(Folder(), {
      {"elastic teeth", with(motor + "[effect.tooth_compliance]\nstiffness_N_per_m = 1e7\ndamping_s_per_m = 1\n"),
       "s.toml:19:1: error: effect.dc_motor has states, which elastic teeth do not carry; state neither inductance_H nor heat_capacity_J_per_K, or switch effect.tooth_compliance off"},
      {"a winding without a heat capacity", with("[effect.dc_motor]\nresistance_ohm = 1\ntorque_constant_Nm_per_A = 0.025\nthermal_resistance_K_per_W = 3\n"),
       "s.toml:19:1: error: effect.dc_motor states thermal_resistance_K_per_W without heat_capacity_J_per_K, which says how fast the winding warms up; add it"},
      {"a current loop without inductance", with("[effect.dc_motor]\nresistance_ohm = 1\ntorque_constant_Nm_per_A = 0.025\ncurrent_bandwidth_Hz = 300\n"),
       "s.toml:19:1: error: effect.dc_motor states current_bandwidth_Hz without inductance_H, against which the loop changes the current; add it"},
      {"a voltage and a current", with(motor + "current_bandwidth_Hz = 300\namplifier_gain_V_per_Nm = 12\n"),
       "s.toml:19:1: error: effect.dc_motor states both amplifier_gain_V_per_Nm and current_bandwidth_Hz: the amplifier gives a voltage or controls the current; leave out one of them"},
      {"a limit of a current that nobody controls", with(motor + "current_limit_A = 3\n"),
       "s.toml:19:1: error: effect.dc_motor states current_limit_A, but not how fast the amplifier keeps to it; add current_bandwidth_Hz, if it controls the current, or limiter_bandwidth_Hz, if it gives a voltage"},
      {"a limiter without a limit", with(motor + "limiter_bandwidth_Hz = 300\n"),
       "s.toml:19:1: error: effect.dc_motor states limiter_bandwidth_Hz without current_limit_A, at which the limiter acts; add it"},
      {"a limiter beside a current loop", with(motor + "current_limit_A = 3\ncurrent_bandwidth_Hz = 300\nlimiter_bandwidth_Hz = 300\n"),
       "s.toml:19:1: error: effect.dc_motor states both current_bandwidth_Hz and limiter_bandwidth_Hz: a loop that controls the current keeps its limit by itself; leave out one of them"},
      {"a limiter without inductance", with("[effect.dc_motor]\nresistance_ohm = 1\ntorque_constant_Nm_per_A = 0.025\ncurrent_limit_A = 3\nlimiter_bandwidth_Hz = 300\n"),
       "s.toml:19:1: error: effect.dc_motor states limiter_bandwidth_Hz without inductance_H, against which the limiter changes the current; add it"},
      {"no resistance", with("[effect.dc_motor]\nresistance_ohm = 0\ntorque_constant_Nm_per_A = 0.025\n"),
       "s.toml:20:18: error: effect.dc_motor.resistance_ohm = 0 ohm must be greater than 0 ohm"},
      {"less than no inductance", with("[effect.dc_motor]\nresistance_ohm = 1\ntorque_constant_Nm_per_A = 0.025\ninductance_H = -1e-3\n"),
       "s.toml:22:16: error: effect.dc_motor.inductance_H = -0.001 H must be at least 0 H"},
      {"no torque constant", with("[effect.dc_motor]\nresistance_ohm = 1\n"),
       "*"}});
}

TEST_CASE("a gearbox that is half stated is rejected with what is missing") {
  const std::string heat = "[effect.gearbox_heat]\nfriction_decay_per_K = 0.01\n";
  check_rejected(Folder(), {
      {"no capacity", with(heat + "thermal_resistance_K_per_W = 2\n"),
       "s.toml:19:1: error: effect.gearbox_heat states thermal_resistance_K_per_W without heat_capacity_J_per_K, which says how fast the gearbox warms up; add it"},
      {"no churning", with(heat + "churning_decay_per_K = 0.02\n"),
       "s.toml:19:1: error: effect.gearbox_heat states churning_decay_per_K without churning_Nms_per_rad, which falls by it; add it, or leave out both"},
      {"no heat to speak of", with(heat + "heat_capacity_J_per_K = 0\n"),
       "s.toml:21:25: error: effect.gearbox_heat.heat_capacity_J_per_K = 0 J/K must be greater than 0 J/K"},
      {"friction that rises", with("[effect.gearbox_heat]\nfriction_decay_per_K = -0.01\n"),
       "s.toml:20:24: error: effect.gearbox_heat.friction_decay_per_K = -0.01 1/K must be at least 0 1/K"},
      {"elastic teeth", with(heat + "heat_capacity_J_per_K = 100\n[effect.tooth_compliance]\nstiffness_N_per_m = 1e7\ndamping_s_per_m = 1\n"),
       "s.toml:19:1: error: effect.gearbox_heat has states, which elastic teeth do not carry; leave heat_capacity_J_per_K out, or switch effect.tooth_compliance off"}});
}

TEST_CASE("stops between which there is nothing, or not the start, are rejected") {
  const std::string stops = "[effect.hard_stops]\n";
  check_rejected(Folder(), {
      {"no stop", with(stops + "restitution = 0.5\n"),
       "s.toml:19:1: error: effect.hard_stops states neither angle_low_deg nor angle_high_deg; add either or both"},
      {"the wrong way round", with(stops + "angle_low_deg = 30\nangle_high_deg = 20\n"),
       "s.toml:19:1: error: effect.hard_stops has angle_low_deg = 30 deg, which must be less than angle_high_deg = 20 deg"},
      {"the start beyond one", with(stops + "angle_low_deg = 30\n"),
       "s.toml:19:1: error: effect.hard_stops leaves out the start, 0 deg: it must lie between the stops"},
      {"another start beyond one", with(stops + "angle_high_deg = 30\n[initial]\ngear_angle_rad = 1\n"),
       "s.toml:19:1: error: effect.hard_stops leaves out the start, 57.2958 deg: it must lie between the stops"},
      {"more than all", with(stops + "angle_low_deg = -30\nrestitution = 1.5\n"),
       "s.toml:21:15: error: effect.hard_stops.restitution = 1.5 must be at least 0 and at most 1"},
      {"elastic teeth", with(stops + "angle_low_deg = -30\n[effect.tooth_compliance]\nstiffness_N_per_m = 1e7\ndamping_s_per_m = 1\n"),
       "s.toml:19:1: error: effect.hard_stops has states, which elastic teeth do not carry; leave it out, or switch effect.tooth_compliance off"}});
}

TEST_CASE("bristles that are half stated are rejected with what is missing") {
  const std::string bristles = "[effect.worm_lugre]\ncoulomb_torque_Nm = 0.01\n";
  check_rejected(Folder(), {
      {"no speed", with(bristles + "static_torque_Nm = 0.02\n"),
       "s.toml:19:1: error: effect.worm_lugre states static_torque_Nm without stribeck_speed_rad_per_s, the speed by which it falls; add it, or leave out both"},
      {"no static torque", with(bristles + "stribeck_speed_rad_per_s = 2\n"),
       "s.toml:19:1: error: effect.worm_lugre states stribeck_speed_rad_per_s without static_torque_Nm, from which friction falls; add it, or leave out both"},
      {"no stiffness", with(bristles + "damping_Nms_per_rad = 1e-3\n"),
       "s.toml:19:1: error: effect.worm_lugre states damping_Nms_per_rad without stiffness_Nm_per_rad, which says how far the bristles bend; add it"},
      {"elastic teeth", with(bristles + "stiffness_Nm_per_rad = 20\n[effect.tooth_compliance]\nstiffness_N_per_m = 1e7\ndamping_s_per_m = 1\n"),
       "s.toml:19:1: error: effect.worm_lugre has states, which elastic teeth do not carry; leave stiffness_Nm_per_rad out, or switch effect.tooth_compliance off"},
      {"no friction", with("[effect.worm_lugre]\ncoulomb_torque_Nm = 0\n"),
       "s.toml:20:21: error: effect.worm_lugre.coulomb_torque_Nm = 0 N m must be greater than 0 N m"}});
}

TEST_CASE("bristles between teeth without friction, or beside what rules them out, are rejected") {
  const std::string bristles = "[effect.mesh_lugre]\nstiffness_per_m = 1000\n";
  std::string smooth = with(bristles);
  const std::string rough = "friction = 0.25";
  smooth.replace(smooth.find(rough), rough.size(), "friction = 0   ");
  check_rejected(Folder(), {
      {"no friction", smooth,
       "s.toml:19:1: error: effect.mesh_lugre needs friction under which its bristles slide, but mesh.friction is 0"},
      {"friction of rest", with(bristles + "[effect.static_friction]\nrise = 0.1\n"),
       "s.toml:19:1: error: effect.mesh_lugre excludes effect.static_friction: teeth on bristles do not rest; effect.stribeck states friction that falls behind break-away; keep one of them"},
      {"no stiffness", with("[effect.mesh_lugre]\nstiffness_per_m = 0\n"),
       "s.toml:20:19: error: effect.mesh_lugre.stiffness_per_m = 0 1/m must be greater than 0 1/m"},
      {"elastic teeth", with(bristles + "[effect.tooth_compliance]\nstiffness_N_per_m = 1e7\ndamping_s_per_m = 1\n"),
       "s.toml:19:1: error: effect.mesh_lugre has states, which elastic teeth do not carry; leave it out, or switch effect.tooth_compliance off"}});
}

TEST_CASE("a linkage whose crank does not come round is rejected with the bars that are too long") {
  const std::string linkage = "[effect.load_four_bar]\ninertia_kgm2 = 0.001\ncrank_m = 0.03\n";
  check_rejected(Folder(), {
      {"too far", with(linkage + "coupler_m = 0.05\nrocker_m = 0.05\nbase_m = 0.08\n"),
       "s.toml:19:1: error: effect.load_four_bar has a crank that does not come round: crank_m + base_m = 0.11 m must be less than coupler_m + rocker_m = 0.1 m by at least 0.01 times the crank"},
      {"too near", with(linkage + "coupler_m = 0.12\nrocker_m = 0.05\nbase_m = 0.08\n"),
       "s.toml:19:1: error: effect.load_four_bar has a crank that does not come round: |crank_m - base_m| = 0.05 m must be more than |coupler_m - rocker_m| = 0.07 m by at least 0.01 times the crank"},
      {"a bar of no length", with(linkage + "coupler_m = 0\nrocker_m = 0.05\nbase_m = 0.08\n"),
       "s.toml:22:13: error: effect.load_four_bar.coupler_m = 0 m must be greater than 0 m"}});
}

TEST_CASE("a crank that cannot turn, or makes a drive jam between its dead centres, is rejected") {
  check_rejected(Folder(), {
      {"short rod", with("[effect.load_crank]\nmass_kg = 1\ncrank_m = 0.05\nrod_m = 0.05\n"),
       "s.toml:19:1: error: effect.load_crank has a rod of 0.05 m, which must be at least 1.01 times as long as the crank, 0.0505 m"},
      {"no crank", with("[effect.load_crank]\nmass_kg = 1\ncrank_m = 0\n"),
       "s.toml:21:11: error: effect.load_crank.crank_m = 0 m must be greater than 0 m"},
      {"jams", with("[effect.load_crank]\nmass_kg = 50\ncrank_m = 0.05\n"),
       "s.toml:8:12: error: mesh.friction = 0.25 violates eq. 17, C1 > -Jw i/Jg: C1 = -0.0470643, -Jw i/Jg = -0.0120726 with Jg = 0.125739 kg m^2*"}});
}

TEST_CASE("a coupling that cannot twist, or on elastic teeth, is rejected with what is missing") {
  const std::string coupling = "[effect.load_coupling]\ninertia_kgm2 = 0.01\n";
  check_rejected(Folder(), {
      {"no stiffness", with(coupling + "damping_Nms_per_rad = 0.1\n"),
       "s.toml:19:1: error: effect.load_coupling states a damping without a stiffness, and a coupling twists only with one; add it, or leave out both"},
      {"no inertia", with("[effect.load_coupling]\ninertia_kgm2 = 0\nstiffness_Nm_per_rad = 10\n"),
       "s.toml:20:16: error: effect.load_coupling.inertia_kgm2 = 0 kg m^2 must be greater than 0 kg m^2"},
      {"elastic teeth", with(coupling + "stiffness_Nm_per_rad = 20\n[effect.tooth_compliance]\nstiffness_N_per_m = 1e7\ndamping_s_per_m = 1\n"),
       "s.toml:19:1: error: effect.load_coupling has states, which elastic teeth do not carry; leave its stiffness out, or switch effect.tooth_compliance off"}});
}

}  // namespace wormdrive::test::cli_bad_effects
