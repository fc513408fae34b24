// One malformed input per line:
// clang-format off
#include "cli/bad_input.hpp"

// What the program says about elastic teeth and backlash that cannot be.

namespace wormdrive::test::cli_bad_teeth {

namespace {

const std::string teeth = "[effect.tooth_compliance]\nstiffness_N_per_m = 1e6\ndamping_s_per_m = 10\n";
const std::string no_gear = "[mesh]\nkind = \"none\"\ninertia_kgm2 = 1\n[run]\nduration_s = 1\n";

std::string with(const std::string& effect) { return good_scenario + effect; }

}  // namespace

TEST_CASE("elastic teeth outside their limits are rejected with the limit") {
  check_rejected(Folder(), {
      {"soft", with("[effect.tooth_compliance]\nstiffness_N_per_m = 0\ndamping_s_per_m = 10\n"),
       "s.toml:20:21: error: effect.tooth_compliance.stiffness_N_per_m = 0 N/m must be greater than 0 N/m"},
      {"driving", with("[effect.tooth_compliance]\nstiffness_N_per_m = 1e6\ndamping_s_per_m = -1\n"),
       "s.toml:21:19: error: effect.tooth_compliance.damping_s_per_m = -1 s/m must be at least 0 s/m"},
      {"driving by a damper", with("[effect.tooth_compliance]\nstiffness_N_per_m = 1e6\ndamping_Ns_per_m = -1\n"),
       "s.toml:21:20: error: effect.tooth_compliance.damping_Ns_per_m = -1 N s/m must be at least 0 N s/m"},
      {"a gap that is none", with(teeth + "[effect.backlash]\ngap_deg = -0.1\n"),
       "s.toml:23:11: error: effect.backlash.gap_deg = -0.1 deg must be at least 0 deg"},
      {"no stiffness", with("[effect.tooth_compliance]\ndamping_s_per_m = 10\n"),
       "s.toml:19:1: error: [effect.tooth_compliance] lacks 'stiffness_N_per_m' (normal force per normal deflection of the teeth)"}});
}

TEST_CASE("a gap as wide as the tooth pitch is rejected with the pitch") {
  check_rejected(Folder(), {
      {"a tooth", with(teeth + "[effect.backlash]\ngap_deg = 6\n"),
       "s.toml:22:1: error: effect.backlash has a gap of 6 deg, which must be less than the pitch of the gear's teeth, 6 deg (360 deg / ratio)"},
      {"a slip in the unit", with(teeth + "[effect.backlash]\ngap_rad = 0.2\n"),
       "s.toml:22:1: error: effect.backlash has a gap of 11.4592 deg, which must be less than the pitch of the gear's teeth, 6 deg (360 deg / ratio)"}});
}

TEST_CASE("tooth effects that exclude or need each other are named") {
  check_rejected(Folder(), {
      {"rigid flanks that meet", with("[effect.backlash]\ngap_deg = 0.1\n"),
       "s.toml:19:1: error: effect.backlash needs elastic teeth; add [effect.tooth_compliance] with stiffness_N_per_m and damping_s_per_m"},
      {"two laws", with(teeth + "damping_Ns_per_m = 10\n"),
       "s.toml:19:1: error: effect.tooth_compliance states damping_s_per_m along with damping_Ns_per_m; keep one, the law of Hunt and Crossley or the limited damper"},
      {"no law", with("[effect.tooth_compliance]\nstiffness_N_per_m = 1e6\n"),
       "s.toml:19:1: error: effect.tooth_compliance states no damping; add damping_s_per_m (law of Hunt and Crossley) or damping_Ns_per_m (limited damper), 0 for none"},
      {"no teeth", no_gear + teeth, "s.toml:6:1: error: effect.tooth_compliance needs teeth, but mesh.kind is \"none\""},
      {"no teeth to have play", no_gear + "[effect.backlash]\ngap_deg = 0.1\n",
       "s.toml:6:1: error: effect.backlash needs teeth, but mesh.kind is \"none\""},
      {"power series", edited(with(teeth), "duration_s = 0.01", "duration_s = 0.01\nsolver = \"taylor\""),
       "s.toml:19:10: error: run.solver = \"taylor\" supports rigid teeth only, but effect.tooth_compliance makes them elastic; set run.solver = \"cvode\""},
      {"a friction that drives", with(teeth + "[effect.mesh_friction]\nchange = -0.3\n"),
       "s.toml:8:12: error: mesh.friction = 0.25 may fall to -0.05 with its effects; friction must be at least 0"}});
}

}  // namespace wormdrive::test::cli_bad_teeth
