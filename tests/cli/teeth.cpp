#include <algorithm>

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "cli/program.hpp"
#include "core/elastic/impact.hpp"
#include "support.hpp"

// Elastic teeth as the program shows them: on the terminal, in its JSON, and in the result file.

namespace wormdrive::test::cli_teeth {

using nlohmann::json;

namespace {

const std::string fig9 = shipped("fig09_backlash.toml"), jam = shipped("jam.toml");

std::string printed(const Folder& folder, const std::vector<std::string>& words) {
  const Outcome outcome = folder.run(words);
  INFO(outcome.err);
  REQUIRE(outcome.exit == 0);
  return outcome.out;
}
void contains(const std::string& out, const std::vector<std::string>& all) {
  for (const std::string& words : all) {
    INFO(words << "\n" << out);
    CHECK(out.find(words) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("a run with elastic teeth says so, describes impacts and audits them") {
  const Folder folder;
  contains(
      printed(folder, {"run", fig9, "--audit"}),
      {"  teeth    elastic: worm and gear are two inertias (compliant drive); 1e+06 N/m, contact at 248 Hz; gap 0.02 "
       "deg or 14.72 um; restitution 0.033 at 0.1 m/s\n",
       "lead_angle_deg = 3.9005 would close it; the flanks follow the ratio\n",
       "78 events: 1 break-away, 5 reversals, 36 impacts, 36 openings\n", "78 guard events, 0 missed"});
  const std::string closed = printed(folder, {"run", fig9, "--audit", "--set", "mesh.lead_angle_deg=3.900493742381"});
  contains(closed, {"0 missed", "; the energy balance closes within "});
  CHECK(closed.find("not confirmed") == std::string::npos);
  // a worm without torque in the gap has margins to break-in that stay at zero without being events
  contains(printed(folder, {"run", jam, "--audit"}), {" 49 guard events, 0 missed; closest graze "});
}

TEST_CASE("check prints the frequency of the contact, the gap along the normal and the restitution") {
  const Folder folder;
  const json derived = json::parse(printed(folder, {"check", fig9, "--json"})).at("derived");
  const GearMesh<double> mesh(table1());
  const ToothContact<double> contact{HuntCrossley<double>{1e6, 300.0}, 0.02 * unit::degree};
  const double mass = effective_mass(mesh, mesh.Jg), frequency = contact_frequency(contact, mass);
  CHECK(close(derived.at("contact frequency").at("value"), frequency / (2.0 * std::numbers::pi), 1e-12));
  CHECK(close(derived.at("contact time").at("value"), 1e3 * std::numbers::pi / frequency, 1e-12));
  CHECK(close(derived.at("gap").at("value"), 1e6 * contact.backlash * mesh.gear_arm(0.0), 1e-12));
  CHECK(close(derived.at("restitution").at("value"), restitution(contact, mass, 0.1), 1e-12));
  CHECK(!json::parse(printed(folder, {"check", shipped("fig09_switching.toml"), "--json"}))
             .at("derived")
             .contains("gap"));
}

TEST_CASE("the result of elastic teeth has its own columns and event kinds") {
  const Folder folder;
  const json said = json::parse(printed(folder, {"run", fig9, "--json", "-o", "r.h5"}));
  const Hdf5Handle file = open_hdf5(folder / "r.h5");
  const auto column = [&](const std::string& name) { return read_column(file, name); };
  const auto theta_g = column("trajectory/gear_angle"), theta_w = column("trajectory/worm_angle"),
             deflection = column("trajectory/deflection"), force = column("trajectory/normal_force"),
             friction = column("trajectory/friction_force"), motion = column("trajectory/motion"),
             flank = column("trajectory/flank");
  REQUIRE(theta_w.size() == theta_g.size());
  for (std::size_t n = 0; n < theta_g.size(); ++n) {
    REQUIRE(std::abs(deflection[n] - (theta_g[n] - theta_w[n] / 60.0)) <= 1e-15);
    REQUIRE((flank[n] != 0.0 || force[n] == 0.0));
    if (motion[n] != 0.0) REQUIRE(std::abs(friction[n] - motion[n] * 0.25 * force[n]) <= 1e-12);
  }
  for (const char* name : {"worm_speed", "worm_acceleration", "gear_motion"})
    REQUIRE(column(std::string("trajectory/") + name).size() == theta_g.size());

  const auto kind = column("events/kind"), before = column("events/flank_before"), after = column("events/flank_after");
  for (std::size_t n = 0; n < kind.size(); ++n) {
    if (kind[n] == 4.0) REQUIRE((before[n] == 0.0 && after[n] != 0.0));
    if (kind[n] == 5.0) REQUIRE((before[n] != 0.0 && after[n] == 0.0));
  }
  CHECK(said.at("events").at("impact") == std::count(kind.begin(), kind.end(), 4.0));
  CHECK(said.at("events").at("opening") == std::count(kind.begin(), kind.end(), 5.0));
  CHECK(said.at("events").at("impact") == 36);
  for (const char* name : {"worm_angle", "worm_speed", "gear_motion_before", "gear_motion_after"})
    REQUIRE(column(std::string("events/") + name).size() == kind.size());

  const Outcome read = Process({WORMDRIVE_PYTHON, h5py_script, folder / "r.h5"}, ".").wait();
  INFO(read.err);
  REQUIRE(read.exit == 0);
  contains(read.out,
           {"trajectory/motion: 1079 int8 over time, -1 backward 0 stuck 1 forward, sign of the worm speed\n",
            "trajectory/deflection: 1079 float64 over time, rad, gear ahead of worm, theta_g - theta_w / i\n",
            "events/kind: 78 int8 over time, 0 break_away 1 stop 2 reversal 3 flank_change 4 impact 5 opening 6 "
            "gear_break_away 7 gear_stop 8 gear_reversal, what happened\n"});
}

TEST_CASE("a result with elastic teeth runs again and is drawn", "[slow]") {
  const Folder folder;
  printed(folder, {"run", jam, "-q", "-o", "r.h5"});
  printed(folder, {"run", "r.h5", "-q"});
  CHECK(read_column(open_hdf5(folder / "r.h5"), "trajectory/worm_angle") ==
        read_column(open_hdf5(folder / "r_again.h5"), "trajectory/worm_angle"));
  printed(folder, {"plot", "r.h5"});
  CHECK(folder.names().count("r.png") == 1);
}

TEST_CASE("effects list elastic teeth and backlash") {
  const Folder folder;
  contains(printed(folder, {"list", "effects"}),
           {"\n  tooth_compliance   mesh: ", "\n      stiffness_N_per_m ", "\n      damping_s_per_m ",
            "\n      damping_Ns_per_m ", "\n  backlash           mesh: ", "\n      gap_deg "});
}

}  // namespace wormdrive::test::cli_teeth
