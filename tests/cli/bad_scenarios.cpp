// One malformed input per line:
// clang-format off
#include "cli/bad_input.hpp"

// What the program says about scenarios that it cannot run.

namespace wormdrive::test::cli_bad_scenarios {

namespace {

const std::string motor = "kind = \"constant\"\ntorque_Nm = -0.05";
const std::string load = "kind = \"constant\"\ntorque_Nm = 0.02";
const std::string mesh = good_scenario.substr(good_scenario.find("[mesh]"), good_scenario.find("[motor") - good_scenario.find("[mesh]"));
const std::string needs_mesh =
    "s.toml: error: there is no [mesh]; it needs ratio, lead_angle_deg, pressure_angle_deg, worm_pitch_radius_m, "
    "gear_pitch_radius_m, friction, worm_inertia_kgm2, gear_inertia_kgm2";

std::string without_mesh(const std::string& before = "") { return before + good_but(mesh, ""); }
std::string with_run(const std::string& line) { return good_but("duration_s = 0.01", "duration_s = 0.01\n" + line); }

}  // namespace

TEST_CASE("a file that is not TOML is rejected with line and column") {
  check_rejected(Folder(), {
      {"no value", good_but("ratio = 60", "ratio = = 60"), "s.toml:3:9: error: not valid TOML: *"},
      {"no bracket", good_but("[mesh]", "[mesh"), "s.toml:2:6: error: not valid TOML: *"},
      {"decimal comma", good_but("ratio = 60", "ratio = 60,5"),
       "s.toml:3:11: error: not valid TOML: Error while parsing key-value pair: expected a comment or whitespace, saw ','; write decimals with a point, as in 0.25"},
      {"no quotes", good_but("\"constant\"", "constant"),
       "s.toml:12:8: error: not valid TOML: Error while parsing value: could not determine value type; a word needs quotes, as in kind = \"constant\""},
      {"a key twice", good_but("ratio = 60", "ratio = 60\nratio = 61"), "s.toml:4:9: error: not valid TOML: *"},
      {"a table twice", good_scenario + "[mesh]\n", "s.toml:19:1: error: not valid TOML: *"},
      {"no end of text", good_but("A good one\"", "A good one"), "s.toml:1:20: error: not valid TOML: *"},
      {"invalid UTF-8", good_but("A good", "A \xff\xfe good"), "s.toml:1:11: error: not valid TOML: *"},
      {"a NUL byte", good_but("ratio", std::string("ra\0tio", 6)),
       "s.toml:3:3: error: a NUL byte; a scenario is plain text or a result file (.h5)"},
      {"a program", std::string("\x7f" "ELF\x02\x01\x01\0\0\0", 10),
       "s.toml:1:8: error: a NUL byte; a scenario is plain text or a result file (.h5)"},
      {"blank", "\n  \n", needs_mesh + "\ns.toml: error: there is no [run]; it needs duration_s"}});
}

TEST_CASE("an empty scenario is rejected with what it needs") {
  const Folder folder;
  folder.write("s.toml", "");
  check_rejected(folder, {{"empty", "", needs_mesh + "\ns.toml: error: there is no [run]; it needs duration_s"}});
}

TEST_CASE("an unknown key is rejected with a suggestion") {
  check_rejected(Folder(), {
      {"letters swapped", good_but("lead_angle_deg", "lead_angel_deg"),
       "s.toml:4:1: error: unknown key 'lead_angel_deg' in [mesh]; did you mean 'lead_angle_deg'?"},
      {"unit forgotten", good_but("worm_inertia_kgm2", "worm_inertia"),
       "s.toml:9:1: error: unknown key 'worm_inertia' in [mesh]; did you mean 'worm_inertia_kgm2'?"},
      {"nothing like it", good_but("[motor.torque]", "colour = \"red\"\n[motor.torque]"),
       "s.toml:11:1: error: unknown key 'colour' in [mesh]; valid keys: kind, ratio, lead_angle_deg, lead_angle_rad, "
       "pressure_angle_deg, pressure_angle_rad, worm_pitch_radius_m, gear_pitch_radius_m, friction, worm_inertia_kgm2, "
       "gear_inertia_kgm2"},
      {"table", good_scenario + "[loads]\n", "s.toml:19:2: error: unknown table 'loads' in the scenario; did you mean 'load'?"},
      {"table of a table", good_scenario + "[mesh.teeth]\n",
       "s.toml:19:7: error: unknown table 'teeth' in [mesh]; valid keys: kind, ratio, lead_angle_deg, lead_angle_rad, "
       "pressure_angle_deg, pressure_angle_rad, worm_pitch_radius_m, gear_pitch_radius_m, friction, worm_inertia_kgm2, "
       "gear_inertia_kgm2"},
      {"effect", good_scenario + "[effect.worm_colomb]\ntorque_Nm = 1e-3\n",
       "s.toml:19:9: error: unknown table 'worm_colomb' in [effect]; did you mean 'worm_coulomb'?"},
      {"key of an effect", good_scenario + "[effect.worm_coulomb]\ntorque = 1e-3\n",
       "s.toml:20:1: error: unknown key 'torque' in [effect.worm_coulomb]; did you mean 'torque_Nm'?"},
      {"a line break in a key", good_scenario + "\"duration\\nms\" = 3\n",
       "s.toml:19:1: error: unknown key 'duration ms' in [run]; did you mean 'duration_s'?"}});
}

TEST_CASE("a value of the wrong type is rejected with the type that it needs") {
  check_rejected(Folder(), {
      {"text for a number", good_but("ratio = 60", "ratio = \"60\""), "s.toml:3:9: error: mesh.ratio must be a number, not a string"},
      {"truth for a number", good_but("ratio = 60", "ratio = true"), "s.toml:3:9: error: mesh.ratio must be a number, not true or false"},
      {"array for a number", good_but("ratio = 60", "ratio = [60]"), "s.toml:3:9: error: mesh.ratio must be a number, not an array"},
      {"table for a number", good_but("ratio = 60", "ratio = {of = 60}"), "s.toml:3:9: error: mesh.ratio must be a number, not a table"},
      {"date for a number", good_but("ratio = 60", "ratio = 2020-01-01"), "s.toml:3:9: error: mesh.ratio must be a number, not a date or time"},
      {"number for a text", good_but("\"A good one\"", "9"), "s.toml:1:9: error: title must be a string, not a number"},
      {"number for a word", good_but(motor, "kind = 3"), "s.toml:12:8: error: motor.torque.kind must be a string, not a number"},
      {"text for a truth", good_scenario + "[effect.worm_coulomb]\ntorque_Nm = 1e-3\non = \"yes\"\n",
       "s.toml:21:6: error: effect.worm_coulomb.on must be true or false, not a string"},
      {"number for a table", without_mesh("mesh = 3\n"), "s.toml:1:8: error: mesh must be a table, not a number"},
      {"array for a table", good_but("[mesh]", "[[mesh]]"), "s.toml:2:1: error: mesh must be a table, not an array"},
      {"number for a torque", good_but("[motor.torque]\n" + motor, "[motor]\ntorque = 3"),
       "s.toml:12:10: error: motor.torque must be a table or an array of tables, not a number"},
      {"number among torques", good_but("[motor.torque]\n" + motor, "[motor]\ntorque = [{kind = \"constant\", torque_Nm = 1}, 3]"),
       "s.toml:12:47: error: motor.torque[1] must be a table, not a number"},
      {"no torques", good_but("[motor.torque]\n" + motor, "[motor]\ntorque = []"),
       "s.toml:12:10: error: motor.torque must be a table or an array of tables, not an empty array"},
      {"effect without a table", good_scenario + "[effect]\nworm_coulomb = 3\n",
       "s.toml:20:16: error: effect.worm_coulomb must be a table, not a number"}});
}

TEST_CASE("a missing key is reported with its meaning") {
  check_rejected(Folder(), {
      {"key", good_but("ratio = 60\n", ""), "s.toml:2:1: error: [mesh] lacks 'ratio' (transmission ratio, worm angle over gear angle)"},
      {"duration", good_but("duration_s = 0.01", ""), "s.toml:17:1: error: [run] lacks 'duration_s' (simulated time)"},
      {"mesh", without_mesh(), needs_mesh},
      {"run", good_but("[run]\nduration_s = 0.01\n", ""), "s.toml: error: there is no [run]; it needs duration_s"},
      {"kind of a torque", good_but(motor, "torque_Nm = 1"),
       "s.toml:11:1: error: [motor.torque] lacks 'kind' (one of \"constant\", \"sinusoid\", \"ramp\", \"step\", \"staircase\", \"samples\")"},
      {"key of one of several torques", good_but("[motor.torque]\n" + motor, "[[motor.torque]]\n" + motor + "\n[[motor.torque]]\nkind = \"ramp\""),
       "s.toml:14:1: error: motor.torque[1] lacks 'rate_Nm_per_s' (slope)"},
      {"key of an effect", good_scenario + "[effect.worm_coulomb]\n",
       "s.toml:19:1: error: [effect.worm_coulomb] lacks 'torque_Nm' (friction torque while the worm turns)"},
      {"arm of a mass", good_but(load, "kind = \"gravity_arm\"\nmass_kg = 1"),
       "s.toml:14:1: error: [load] lacks 'torque_Nm', or 'mass_kg' and 'arm_m'"},
      {"arm among several loads", good_but("[load]\n" + load, "[[load]]\n" + load + "\n[[load]]\nkind = \"gravity_arm\"\narm_m = 1"),
       "s.toml:17:1: error: load[1] lacks 'torque_Nm', or 'mass_kg' and 'arm_m'"},
      {"speed of a fan", good_but(load, "kind = \"fan\"\ntorque_Nm = 1"),
       "s.toml:14:1: error: [load] lacks 'speed_rad_per_s' (gear speed at which it is stated)"},
      {"angle of a stop", good_but(load, "kind = \"end_stops\"\nstiffness_Nm_per_rad = 1"),
       "s.toml:14:1: error: [load] lacks 'angle_low_deg' or 'angle_high_deg'"},
      {"order of two stops", good_but(load, "kind = \"end_stops\"\nstiffness_Nm_per_rad = 1\nangle_low_rad = 0.5\nangle_high_deg = 20"),
       "s.toml:18:18: error: load.angle_high_deg must be greater than angle_low_rad"},
      {"everything of an arm", good_but(load, "kind = \"gravity_arm\""),
       "s.toml:14:1: error: [load] lacks 'torque_Nm', or 'mass_kg' and 'arm_m'"}});
}

TEST_CASE("a value outside its limits is rejected with unit and limits") {
  check_rejected(Folder(), {
      {"inertia", good_but("7.39e-4", "-7.39e-4"),
       "s.toml:10:21: error: mesh.gear_inertia_kgm2 = -0.000739 kg m^2 must be greater than 0 kg m^2"},
      {"ratio", good_but("ratio = 60", "ratio = 0"), "s.toml:3:9: error: mesh.ratio = 0 must be greater than 0"},
      {"lead angle 0", good_but("lead_angle_deg = 4", "lead_angle_deg = 0"),
       "s.toml:4:18: error: mesh.lead_angle_deg = 0 deg must be greater than 0 deg and at most 45 deg"},
      {"lead angle 50", good_but("lead_angle_deg = 4", "lead_angle_deg = 50"),
       "s.toml:4:18: error: mesh.lead_angle_deg = 50 deg must be greater than 0 deg and at most 45 deg"},
      {"lead angle in rad", good_but("lead_angle_deg = 4", "lead_angle_rad = 0.9"),
       "s.toml:4:18: error: mesh.lead_angle_rad = 0.9 rad must be greater than 0 rad and at most 0.785398 rad"},
      {"pressure angle", good_but("pressure_angle_deg = 20", "pressure_angle_deg = 90"),
       "s.toml:5:22: error: mesh.pressure_angle_deg = 90 deg must be at least 0 deg and less than 90 deg"},
      {"nan", good_but("ratio = 60", "ratio = nan"), "s.toml:3:9: error: mesh.ratio = nan must be a finite number"},
      {"inf", good_but("torque_Nm = 0.02", "torque_Nm = -inf"), "s.toml:16:13: error: load.torque_Nm = -inf must be a finite number"},
      {"effect", good_scenario + "[effect.gear_viscous]\ncoefficient_Nms_per_rad = -1\n",
       "s.toml:20:27: error: effect.gear_viscous.coefficient_Nms_per_rad = -1 N m s/rad must be at least 0 N m s/rad"},
      {"a fan that drives", good_but(load, "kind = \"fan\"\ntorque_Nm = -1\nspeed_rad_per_s = 2"),
       "s.toml:16:13: error: load.torque_Nm = -1 N m must be at least 0 N m"},
      {"a fan at no speed", good_but(load, "kind = \"fan\"\ntorque_Nm = 1\nspeed_rad_per_s = 0"),
       "s.toml:17:19: error: load.speed_rad_per_s = 0 rad/s must be greater than 0 rad/s"},
      {"duration", good_but("duration_s = 0.01", "duration_s = 0"), "s.toml:18:14: error: run.duration_s = 0 s must be greater than 0 s"},
      {"report interval", with_run("report_interval_s = 1"),
       "s.toml:19:21: error: run.report_interval_s = 1 s must be at most the duration, 0.01 s"},
      {"number of reports", with_run("report_interval_s = 1e-14"),
       "s.toml:19:21: error: run.report_interval_s = 1e-14 s would give 1e+12 rows; at most 1e+09 are written"},
      {"tolerance 0", with_run("relative_tolerance = 0"),
       "s.toml:19:22: error: run.relative_tolerance = 0 must be at least 1e-14 and at most 0.01"},
      {"tolerance 1e-20", with_run("relative_tolerance = 1e-20"),
       "s.toml:19:22: error: run.relative_tolerance = 1e-20 must be at least 1e-14 and at most 0.01"},
      {"limits of no motor", good_scenario + "[limits]\ntorque_Nm = 0\n", "s.toml:20:13: error: limits.torque_Nm = 0 N m must be greater than 0 N m"},
      {"limits without room", good_scenario + "[limits]\nangle_low_deg = 30\nangle_high_deg = 10\n",
       "s.toml:20:17: error: limits.angle_low_deg = 30 must be below limits.angle_high_deg = 10"}});
}

TEST_CASE("an unknown word is rejected with the known ones") {
  check_rejected(Folder(), {
      {"solver", with_run("solver = \"euler\""), "s.toml:19:10: error: run.solver = \"euler\" must be one of \"cvode\", \"taylor\""},
      {"method", with_run("method = \"euler\""), "s.toml:19:10: error: run.method = \"euler\" must be one of \"bdf\", \"adams\""},
      {"torque", good_but(motor, "kind = \"sinus\""),
       "s.toml:12:8: error: motor.torque.kind = \"sinus\" must be one of \"constant\", \"sinusoid\", \"ramp\", \"step\", \"staircase\", \"samples\""},
      {"load", good_but(load, "kind = \"gravity\""),
       "s.toml:15:8: error: load.kind = \"gravity\" must be one of \"constant\", \"sinusoid\", \"ramp\", \"step\", \"staircase\", \"samples\", \"gravity_arm\", \"angle_table\", \"fan\", \"end_stops\""},
      {"one of several loads", good_but("[load]\n" + load, "[[load]]\n" + load + "\n[[load]]\nkind = \"gravity\""),
       "s.toml:18:8: error: load[1].kind = \"gravity\" must be one of \"constant\", \"sinusoid\", \"ramp\", \"step\", \"staircase\", \"samples\", \"gravity_arm\", \"angle_table\", \"fan\", \"end_stops\""},
      {"mesh", good_but("[mesh]", "[mesh]\nkind = \"spur\""), "s.toml:3:8: error: mesh.kind = \"spur\" must be one of \"worm\", \"data_sheet\", \"none\""}});
}

TEST_CASE("contradicting statements are reported at the one to remove") {
  check_rejected(Folder(), {
      {"deg and rad", good_but("lead_angle_deg = 4", "lead_angle_deg = 4\nlead_angle_rad = 0.07"),
       "s.toml:5:18: error: mesh.lead_angle_rad is stated twice, also as lead_angle_deg; keep one"},
      {"torque and mass", good_but(load, "kind = \"gravity_arm\"\nmass_kg = 1\ntorque_Nm = 0.02"),
       "s.toml:17:13: error: load.torque_Nm is stated along with mass_kg or arm_m; keep the torque, or the two others"},
      {"torque and mass of one of several loads",
       good_but("[load]\n" + load, "[[load]]\n" + load + "\n[[load]]\nkind = \"gravity_arm\"\nmass_kg = 1\ntorque_Nm = 0.02"),
       "s.toml:20:13: error: load[1].torque_Nm is stated along with mass_kg or arm_m; keep the torque, or the two others"}});
}

TEST_CASE("a gear without a unique motion is rejected with the limit") {
  check_rejected(Folder(), {
      {"mu_g", good_but("friction = 0.25", "friction = 14"),
       "s.toml:8:12: error: mesh.friction = 14 is not below mu_g = 13.4382 (cos(phi_n)/tan(lambda)): the worm would lock itself; only elastic teeth, [effect.tooth_compliance], allow it"},
      {"eq. 17", good_but("7.39e-4", "1"),
       "s.toml:8:12: error: mesh.friction = 0.25 violates eq. 17, C1 > -Jw i/Jg: C1 = -0.0470643, -Jw i/Jg = -0.001518 with "
       "Jg = 1 kg m^2; the rigid drive would jam. Lower the friction, raise worm_inertia_kgm2, lower the gear-side "
       "inertia below 0.0322537 kg m^2, or add [effect.tooth_compliance]: elastic teeth can jam"}});
}

TEST_CASE("all faults of a file are reported at once, in the order of its lines") {
  std::string text = good_but("ratio = 60", "ratio = \"x\"");
  text = edited(text, "pressure_angle_deg", "pressure_angle_dg");
  text = edited(text, "friction = 0.25", "friction = -1");
  text = edited(text, "torque_Nm = 0.02", "torque_Nm = inf");
  text = edited(text, "duration_s = 0.01", "duration_s = -1");
  check_rejected(Folder(), {{"five faults and an override", text,
                         "--set mesh.lead_angle_deg=50: error: mesh.lead_angle_deg = 50 deg must be greater than 0 deg and at most 45 deg\n"
                         "s.toml:3:9: error: mesh.ratio must be a number, not a string\n"
                         "s.toml:5:1: error: unknown key 'pressure_angle_dg' in [mesh]; did you mean 'pressure_angle_deg'?\n"
                         "s.toml:8:12: error: mesh.friction = -1 must be at least 0\n"
                         "s.toml:16:13: error: load.torque_Nm = inf must be a finite number\n"
                         "s.toml:18:14: error: run.duration_s = -1 s must be greater than 0 s",
                         {"--set", "mesh.lead_angle_deg=50"}}});
}

}  // namespace wormdrive::test::cli_bad_scenarios
