#include <cmath>

#include "catch.hpp"
#include "cli/bad_input.hpp"

// A drive without teeth on a linear axis: masses, forces and positions in m, N, kg, in the scenario and in the result.

namespace wormdrive::test::scenarios_linear_axis {

namespace {

/// 2 kg pushed with 3 N against dry friction of 1 N: 1 m/s^2.
const std::string sledge = sledge_of_two_kilograms + R"([motor.torque]
kind = "constant"
force_N = 3.5
[load]
kind = "constant"
force_N = -0.5
[effect.gear_coulomb]
force_N = 1
[initial]
position_m = 0.25
speed_m_per_s = 0
[run]
duration_s = 2
)";

std::string text_of(hid_t file, const std::string& column, const std::string& attribute) {
  const Hdf5Handle dataset(H5Dopen2(file, column.c_str(), H5P_DEFAULT), H5Dclose, "cannot open " + column);
  return read_text_attribute(dataset, attribute);
}

}  // namespace

TEST_CASE("a mass on a linear axis moves as its forces say, in m, m/s and N") {
  const Folder folder;
  folder.write("s.toml", sledge);
  const Outcome outcome = folder.run({"run", "s.toml", "-q"});
  INFO(outcome.err);
  REQUIRE(outcome.exit == 0);
  const Hdf5Handle file = open_hdf5(folder / "s.h5");
  const auto column = [&](const std::string& name) { return read_column(file, "trajectory/" + name); };
  const std::vector<double> t = column("time"), x = column("gear_angle"), v = column("gear_speed"),
                            a = column("gear_acceleration");
  REQUIRE(t.size() == 1001);
  double worst = 0.0;
  for (std::size_t k = 0; k < t.size(); ++k)
    worst = std::max({worst, std::abs(x[k] - 0.25 - 0.5 * t[k] * t[k]), std::abs(v[k] - t[k]), std::abs(a[k] - 1.0)});
  REQUIRE(worst <= 1e-8);
  REQUIRE(column("motor_torque").back() == 3.5);
  REQUIRE(column("load_torque").back() == -0.5);
  for (const auto& [name, units] : {std::pair{"gear_angle", "m"},
                                    {"gear_speed", "m/s"},
                                    {"gear_acceleration", "m/s^2"},
                                    {"motor_torque", "N"},
                                    {"load_torque", "N"},
                                    {"normal_force", "N"},
                                    {"time", "s"}})
    CHECK(text_of(file, std::string("trajectory/") + name, "units") == units);
  for (const auto& [name, units] : {std::pair{"gear_angle", "m"},
                                    {"gear_speed", "m/s"},
                                    {"acceleration_before", "m/s^2"},
                                    {"motor_torque_after", "N"},
                                    {"load_torque_before", "N"}})
    CHECK(text_of(file, std::string("events/") + name, "units") == units);
}

TEST_CASE("every kind of force and load is stated in the units of a linear axis") {
  const Folder folder;
  const std::string motor = "[motor.torque]\nkind = \"constant\"\nforce_N = 3.5\n",
                    load = "[load]\nkind = \"constant\"\nforce_N = -0.5\n";
  folder.write("f.csv", "time_s,motor_force_N,load_force_N\n0,1,-1\n1,2,-2\n");
  folder.write("x.csv", "position_m,load_force_N\n0,1\n1,2\n2,3\n3,3\n");
  std::string forces;
  for (const std::string keys :
       {"kind = \"sinusoid\"\namplitude_N = 1\nfrequency_Hz = 2\nphase_deg = 90", "kind = \"ramp\"\nrate_N_per_s = 1",
        "kind = \"step\"\nforce_N = 1\ntime_s = 1", "kind = \"staircase\"\nrise_N = 1\ninterval_s = 1",
        "kind = \"samples\"\nforces_N = [1, 2]\ntimes_s = [0, 1]", "kind = \"samples\"\nfile = \"f.csv\""})
    forces += "[[motor.torque]]\n" + keys + "\n";
  for (const std::string keys : {"kind = \"angle_table\"\npositions_m = [0, 1, 2, 3]\nforces_N = [1, 2, 3, 3]",
                                 "kind = \"angle_table\"\nfile = \"x.csv\"", "kind = \"samples\"\nfile = \"f.csv\"",
                                 "kind = \"step\"\nforce_N = 1\ntime_s = 1"}) {
    folder.write("s.toml", edited(edited(sledge, motor, forces), load, "[load]\n" + keys + "\n") +
                               "[effect.worm_viscous]\ncoefficient_Ns_per_m = 0.1\n");
    const Outcome outcome = folder.run({"run", "s.toml", "-q"});
    INFO(keys << "\n" << outcome.err);
    REQUIRE(outcome.exit == 0);
    REQUIRE(folder.run({"run", "s.h5", "-q", "-o", "again.h5"}).exit == 0);
    const Hdf5Handle one = open_hdf5(folder / "s.h5"), two = open_hdf5(folder / "again.h5");
    REQUIRE(bytes(one, "trajectory") == bytes(two, "trajectory"));
  }
}

TEST_CASE("what turns has no place on a linear axis, and is told in its words") {
  const std::string load = "kind = \"constant\"\nforce_N = -0.5";
  check_rejected(Folder(),
                 {{"torque", edited(sledge, load, "kind = \"constant\"\ntorque_Nm = 1"),
                   "s.toml:9:1: error: [load] lacks 'force_N' (force)\n"
                   "s.toml:11:1: error: unknown key 'torque_Nm' in [load]; valid keys: kind, force_N"},
                  {"inertia", edited(sledge, "mass_kg = 2", "inertia_kgm2 = 2"),
                   "s.toml:2:1: error: [mesh] lacks 'mass_kg' (mass that moves)\n"
                   "s.toml:5:1: error: unknown key 'inertia_kgm2' in [mesh]; valid keys: kind, axis, mass_kg"},
                  {"mass", edited(sledge, "mass_kg = 2", "mass_kg = 0"),
                   "s.toml:5:11: error: mesh.mass_kg = 0 kg must be greater than 0 kg"},
                  {"gravity arm", edited(sledge, load, "kind = \"gravity_arm\"\nforce_N = 1"),
                   "s.toml:10:8: error: load.kind = \"gravity_arm\" must be one of \"constant\", \"sinusoid\", "
                   "\"ramp\", \"step\", \"staircase\", "
                   "\"samples\", \"angle_table\", \"fan\", \"end_stops\""},
                  {"axis", edited(sledge, "axis = \"linear\"", "axis = \"straight\""),
                   "s.toml:4:8: error: mesh.axis = \"straight\" must be one of \"rotary\", \"linear\""},
                  {"axis of a worm gear", good_but("[mesh]", "[mesh]\naxis = \"linear\""),
                   "s.toml:3:1: error: unknown key 'axis' in [mesh]; valid keys: kind, ratio, lead_angle_deg, "
                   "lead_angle_rad, pressure_angle_deg, "
                   "pressure_angle_rad, worm_pitch_radius_m, gear_pitch_radius_m, friction, worm_inertia_kgm2, "
                   "gear_inertia_kgm2"}});
}

TEST_CASE("the statement of a linear axis survives check, and statics says that only teeth lock") {
  const Folder folder;
  folder.write("s.toml", sledge);
  const Outcome check = folder.run({"check", "s.toml"});
  REQUIRE(check.exit == 0);
  for (const std::string words :
       {"mesh.mass_kg", "2 kg", "mass that moves", "initial.position_m", "0.25 m", "effect.gear_coulomb.force_N"})
    CHECK(check.out.find(words) != std::string::npos);
  CHECK(folder.run({"statics", "s.toml"}).exit == 2);
}

}  // namespace wormdrive::test::scenarios_linear_axis
