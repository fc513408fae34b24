#include <algorithm>
#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "cli/program.hpp"
#include "description/toml/parse_scenario.hpp"
#include "description/toml/write_scenario.hpp"
#include "output/hdf5/hdf5.hpp"
#include "support.hpp"

// Several loads in one scenario, on their way through the program.

namespace wormdrive::test::scenarios_load_sums {

namespace {

const std::string loads = R"([[load]]
kind = "gravity_arm"
torque_Nm = 0.15
angle_offset_deg = 33.3
[[load]]
kind = "constant"
torque_Nm = -0.05
[[load]]
kind = "sinusoid"
amplitude_Nm = 0.04
frequency_Hz = 2
[[load]]
kind = "angle_table"
angles_deg = [-90, -20, 10, 60]
torques_Nm = [0.02, 0.03, -0.04, 0]
[[load]]
kind = "fan"
torque_Nm = 0.3
speed_rad_per_s = 2
[[load]]
kind = "end_stops"
angle_high_deg = 12
stiffness_Nm_per_rad = 3
damping_s_per_rad = 0.2
)";

std::string scenario() {
  const std::string load = "[load]\nkind = \"constant\"\ntorque_Nm = 0.02\n";
  const std::string motor = "kind = \"constant\"\ntorque_Nm = -0.05";
  std::string text = edited(good_but(load, loads), motor,
                            "kind = \"sinusoid\"\namplitude_Nm = 0.06\nfrequency_Hz = 1.5\nphase_deg = 90");
  return edited(text, "duration_s = 0.01", "duration_s = 2");
}

}  // namespace

TEST_CASE("a scenario with loads that add up is the same after it was written and read") {
  const Scenario s = parse_scenario(scenario(), "text", {}, Purpose::run);
  REQUIRE(std::get<LoadSum>(s.load).terms.size() == 6);
  const std::string text = to_toml(s);
  INFO(text);
  const Scenario read = parse_scenario(text, "text", {}, Purpose::run);
  REQUIRE(to_toml(read) == text);
  const auto& arm = std::get<GravityArm>(std::get<LoadSum>(read.load).terms[0]);
  REQUIRE(arm.offset == 33.3 * unit::degree);
}

TEST_CASE(
    "loads that add up give the same events with both solvers, confirmed by the audit, and their sum in the result") {
  const Folder folder;
  folder.write("s.toml", scenario());
  std::vector<double> times[2];
  for (const int solver : {0, 1}) {
    const std::string name = solver == 0 ? "cvode" : "taylor";
    const Outcome outcome =
        folder.run({"run", "s.toml", "--audit", "--json", "-o", name + ".h5", "--set", "run.solver=" + name});
    INFO(outcome.err);
    REQUIRE(outcome.exit == 0);
    const auto json = nlohmann::json::parse(outcome.out);
    REQUIRE(json["audit"]["missed"] == 0);
    REQUIRE(json["audit"]["not_confirmed"] == 0);
    const Hdf5Handle file = open_hdf5(folder / (name + ".h5"));
    times[solver] = read_column(file, "events/time");
    const auto t = read_column(file, "trajectory/time"), theta = read_column(file, "trajectory/gear_angle"),
               omega = read_column(file, "trajectory/gear_speed"), torque = read_column(file, "trajectory/load_torque");
    const auto table = make_load(AngleTable{
        {-90 * unit::degree, -20 * unit::degree, 10 * unit::degree, 60 * unit::degree}, {0.02, 0.03, -0.04, 0}});
    for (std::size_t k = 0; k < t.size(); ++k) {
      const double depth = std::max(0.0, theta[k] - 12 * unit::degree);
      const double by_hand =
          0.15 * std::cos(theta[k] + 33.3 * unit::degree) - 0.05 + 0.04 * std::cos(4 * std::numbers::pi * t[k]) +
          table.torque(Moment<double>{t[k], theta[k], 0, 0}) - 0.3 / 4.0 * omega[k] * std::abs(omega[k]) -
          std::max(0.0, 3.0 * depth * (1.0 + 0.2 * omega[k]));
      REQUIRE(std::abs(torque[k] - by_hand) <= 1e-14);
    }
  }
  REQUIRE(times[0].size() >= 8);
  REQUIRE(times[0].size() == times[1].size());
  for (std::size_t k = 0; k < times[0].size(); ++k) REQUIRE(std::abs(times[0][k] - times[1][k]) <= 1e-9);
}

TEST_CASE("every command takes loads that add up, and an override names the one that it changes") {
  const Folder folder;
  folder.write("s.toml", scenario());
  for (const std::string command : {"check", "statics", "steady"}) {
    const Outcome outcome = folder.run({command, "s.toml"});
    INFO(command << outcome.err);
    CHECK(outcome.exit == 0);
  }
  CHECK(folder.run({"fmu", "s.toml"}).exit == 0);
  const std::string check = folder.run({"check", "s.toml", "--set", "load[4].torque_Nm=0.7"}).out;
  CHECK(check.find("load[4].torque_Nm") != std::string::npos);
  CHECK(check.find("load[3]") != std::string::npos);
  CHECK(folder.run({"list", "loads"}).out.find("fan") != std::string::npos);
  // at a constant speed the fan is part of the load; tau_m = -C2 tau_l on the flank that hinders
  const auto torque = [&](const std::string& rated) {
    const auto json =
        nlohmann::json::parse(folder
                                  .run({"steady", "s.toml", "--json", "--points", "1", "--max-speed", "120", "--set",
                                        "load={kind=\"fan\",torque_Nm=" + rated + ",speed_rad_per_s=2}"})
                                  .out);
    return json["motor_torque_Nm"].back().get<double>();
  };
  const GearMesh<double> mesh(table1());
  CHECK(std::abs(torque("0.3") - mesh.C2() * 0.3 / 4.0) <= 1e-14);  // at half of 120 rad/s, 1 rad/s of the gear
}

TEST_CASE("a sweep varies one of several loads") {
  const Folder folder;
  folder.write("s.toml", scenario());
  folder.write("study.toml",
               "scenario = \"s.toml\"\n[sweep]\ndesign = \"monte_carlo\"\ntrials = 4\nseed = 1\n"
               "[[parameter]]\npath = \"load[4].torque_Nm\"\ndistribution = \"uniform\"\nlow = 0.1\nhigh = 0.5\n");
  const Outcome outcome = folder.run({"sweep", "study.toml", "-q"});
  INFO(outcome.err);
  CHECK(outcome.exit == 0);
}

TEST_CASE("a sweep names the only one of [[load]] with its index or without, whatever its kind is") {
  const Folder folder;
  for (const char* load : {"kind = \"gravity_arm\"\ntorque_Nm = 0.3\n", "kind = \"constant\"\ntorque_Nm = 0.3\n",
                           "kind = \"fan\"\ntorque_Nm = 0.3\nspeed_rad_per_s = 2\n"})
    for (const char* path : {"load.torque_Nm", "load[0].torque_Nm"}) {
      folder.write("one.toml",
                   good_but("[load]\nkind = \"constant\"\ntorque_Nm = 0.02\n", std::string("[[load]]\n") + load));
      folder.write("study.toml", std::string("scenario = \"one.toml\"\n[sweep]\ndesign = \"monte_carlo\"\ntrials = 2\n"
                                             "seed = 1\n[[parameter]]\npath = \"") +
                                     path + "\"\ndistribution = \"uniform\"\nlow = 0.1\nhigh = 0.5\n");
      const Outcome outcome = folder.run({"sweep", "study.toml", "-q", "--force"});
      INFO(load << path << outcome.err);
      CHECK(outcome.exit == 0);
    }
}

}  // namespace wormdrive::test::scenarios_load_sums
