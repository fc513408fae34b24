#include <cmath>

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "cli/program.hpp"
#include "description/toml/parse_scenario.hpp"
#include "description/toml/write_scenario.hpp"
#include "output/hdf5/hdf5.hpp"
#include "support.hpp"

// Controlled scenarios on their way through the program: written, stored, run again, checked, shown.

namespace wormdrive::test::scenarios_controlled_runs {

namespace {

constexpr const char* everything = R"([controller]
kind = "KIND"
sample_time_s = 0.0013
sample_offset_s = 1e-4
delay_samples = 1
LAW
MODEL[[reference]]
kind = "chirp"
amplitude_deg = 0.7
first_frequency_Hz = 0.1
last_frequency_Hz = 3
duration_s = 1
[[reference]]
kind = "table"
times_s = [0, 0.1, 0.3, 0.7]
angles_deg = [0, 1.1, -0.7, 33.3]
[[reference]]
kind = "random_steps"
amplitude_rad = 0.01
interval_s = 0.07
seed = 5
[[reference]]
kind = "multisine"
amplitude_rad = 0.001
lowest_frequency_Hz = 1
highest_frequency_Hz = 7
[[reference]]
kind = "trapezoid"
angle_rad = 0.1
max_speed_rad_per_s = 0.5
acceleration_rad_per_s2 = 3
[[reference]]
kind = "step"
angle_rad = 0.01
time_s = 0.2
[sensor]
shaft = "worm"
counts = 500
noise_rad = 1e-5
seed = 9
zero_error_rad = 0.02
index_mark_deg = 33
speed_filter_Hz = 150
[disturbance]
deviation_Nm = 1e-4
time_constant_s = 0.01
seed = 11
[metrics]
from_s = 0.1
to_s = 0.4
)";

const std::string model = R"([controller.nominal]
C1 = -0.05
load_angle_offset_deg = 33.3
load_constant_Nm = 1e-3
[controller.variation]
friction = 0.1
load = 0.3
)";

bool knows_a_model(const std::string& kind) { return kind == "sliding" || kind == "pid"; }

/// A scenario that states everything a controller can have.
std::string full(const std::string& kind, const std::string& law) {
  const std::string motor = "[motor.torque]\nkind = \"constant\"\ntorque_Nm = -0.05\n";
  const std::string known = edited(everything, "MODEL", knows_a_model(kind) ? model : "");
  const std::string text = edited(edited(known, "KIND", kind), "LAW", law);
  return edited(good_but(motor, text), "duration_s = 0.01", "duration_s = 0.5");
}

const std::pair<const char*, const char*> laws[] = {
    {"sliding",
     "bandwidth_rad_per_s = 70\nlayer_rad_per_s = 0.4\neta_rad_per_s2 = 20\nbeta2 = 2.5\nE1_rad_per_s2 = 0.3\n"
     "anti_windup = \"back_calculation\"\ntracking_time_s = 0.007"},
    {"pid",
     "integral_weight = 1e6\nangle_weight = 10\nspeed_weight = 0.01\nfeedforward = 0.5\n"
     "anti_windup = \"model_recovery\""},
    {"position_servo", "gain_Nm_per_rad = 3\ndamping_Nms_per_rad = 0.1\ntorque_limit_Nm = 0.2\ndead_band_deg = 0.033"},
    {"open_loop", "[[controller.torque]]\nkind = \"sinusoid\"\namplitude_Nm = 0.03\nfrequency_Hz = 3"}};

}  // namespace

TEST_CASE("a controlled scenario is the same after it was written and read, with every law and reference") {
  for (const auto& [kind, law] : laws) {
    const Scenario s = parse_scenario(full(kind, law), "text", {}, Purpose::run);
    const std::string text = to_toml(s);
    INFO(text);
    const Scenario read = parse_scenario(text, "text", {}, Purpose::run);
    REQUIRE(to_toml(read) == text);
    REQUIRE(read.control->reference.terms.size() == 6);
    for (const double t : {0.0, 0.05, 0.23, 0.41, 0.9}) {
      REQUIRE(read.control->reference.at(t).angle == s.control->reference.at(t).angle);
      REQUIRE(read.control->reference.at(t).acceleration == s.control->reference.at(t).acceleration);
    }
    if (!knows_a_model(kind)) continue;
    REQUIRE(*read.control->nominal.load_angle_offset == 33.3 * unit::degree);
    REQUIRE(!read.control->nominal.C2);  // what follows from the drive still does
  }
}

TEST_CASE("a controlled result is simulated again to the last bit, samples included") {
  const Folder folder;
  for (const auto& [kind, law] : laws) {
    folder.write("s.toml", full(kind, law));
    const Outcome outcome = folder.run({"run", "s.toml", "-q", "-o", "first.h5", "--set", "mesh.friction=0.21"});
    INFO(outcome.err);
    REQUIRE(outcome.exit == 0);
    REQUIRE(folder.run({"run", "first.h5", "-q", "-o", "again.h5"}).exit == 0);
    const Hdf5Handle first = open_hdf5(folder / "first.h5"), again = open_hdf5(folder / "again.h5");
    for (const char* group : {"trajectory", "events", "controller"}) {
      const auto expected = bytes(first, group);
      REQUIRE(!expected.begin()->second.empty());
      REQUIRE(bytes(again, group) == expected);
    }
    REQUIRE(read_text_attribute(first, "scenario") == read_text_attribute(again, "scenario"));
  }
}

TEST_CASE("the samples in a result are those of the controller: times, delay, and the torque of the trajectory") {
  const Folder folder;
  folder.write("s.toml", full(laws[1].first, laws[1].second));
  REQUIRE(folder.run({"run", "s.toml", "-q"}).exit == 0);
  const Hdf5Handle file = open_hdf5(folder / "s.h5");
  const auto time = read_column(file, "controller/time"), decided = read_column(file, "controller/torque"),
             applied = read_column(file, "controller/applied_torque"),
             disturbance = read_column(file, "controller/disturbance_torque");
  const auto row = read_column(file, "trajectory/time"), torque = read_column(file, "trajectory/motor_torque");
  REQUIRE(time.size() == 385);  // (0.5 - 1e-4)/0.0013 + 1
  std::size_t at = 0;
  double deviation = 0.0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    REQUIRE(std::abs(time[k] - (1e-4 + 0.0013 * k)) <= 1e-15);
    while (row[at] < time[k]) ++at;
    REQUIRE(row[at] == time[k]);
    REQUIRE(torque[at] == applied[k]);
    if (k > 0) REQUIRE(applied[k] == decided[k - 1]);
    deviation = std::max(deviation, std::abs(disturbance[k]));
  }
  REQUIRE((deviation > 1e-5 && deviation < 6e-4));  // the disturbance
}

TEST_CASE("an audit of a controlled run finds every event confirmed") {
  const Folder folder;
  const Outcome outcome = folder.run({"run", shipped("fig10_sliding_014deg_bare.toml"), "--audit", "--json", "-o",
                                      "r.h5", "--set", "run.duration_s=1.5"});
  REQUIRE(outcome.exit == 0);
  const auto json = nlohmann::json::parse(outcome.out);
  REQUIRE(json["audit"]["missed"] == 0);
  REQUIRE(json["audit"]["not_confirmed"] == 0);
  REQUIRE(json["audit"]["events"] > 0);
  REQUIRE(json["audit"]["largest_angle_error"] < 1e-9);
  REQUIRE(json["control"]["metrics"]["error_peak_to_peak"]["value"] < 1.2e-4);
  REQUIRE(json["control"]["violations"].empty());
}

TEST_CASE("check shows gains and Lemma 1, and names what fails with the value that would satisfy it") {
  const Folder folder;
  const std::string sliding = shipped("fig10_sliding_014rad_bare.toml");
  const Outcome good = folder.run({"check", sliding});
  REQUIRE(good.out.find("M 0.00402609 N m, least eta 1.28672 rad/s^2") != std::string::npos);
  REQUIRE(good.out.find("FAILS") == std::string::npos);
  const Outcome bad =
      folder.run({"check", sliding, "--set", "controller.eta_rad_per_s2=1", "--set", "controller.beta1=1.5"});
  REQUIRE(bad.exit == 0);
  REQUIRE(bad.out.find("FAILS by 0.2867; controller.eta_rad_per_s2 = 1.28672 would satisfy it") != std::string::npos);
  REQUIRE(bad.out.find("FAILS by 0.5; controller.beta1 = 2 would satisfy it") != std::string::npos);
  REQUIRE(
      bad.out.find(
          "warning  Lemma 1 does not hold (wormdrive check prints the details): beta1 >= 2; eta >= M b_hat/2 - E") !=
      std::string::npos);
  const Outcome rough =
      folder.run({"check", sliding, "--set", "controller.variation.C1=0", "--set", "controller.variation.C2=0", "--set",
                  "controller.variation.friction=0.1", "--set", "effect.mesh_friction.change=0.05"});
  INFO(rough.out << rough.err);
  REQUIRE(rough.exit == 0);
  REQUIRE(rough.out.find("|C1 - C1_hat| ") != std::string::npos);
  REQUIRE(rough.out.find("; a larger controller.variation.friction would cover it") != std::string::npos);
  const auto json = nlohmann::json::parse(folder.run({"check", shipped("fig10_pid_014rad_bare.toml"), "--json"}).out);
  REQUIRE(close(json["controller"]["gains"]["Kd"], 0.3063, 1e-3));  // 2 p M
}

TEST_CASE("a run reports what it broke of Lemma 1 with its time and is no failure") {
  const Folder folder;
  const Outcome run =
      folder.run({"run", shipped("fig10_sliding_014rad_bare.toml"), "-o", "r.h5", "--set", "load.torque_Nm=1.5"});
  INFO(run.out);
  REQUIRE(run.exit == 0);
  REQUIRE(run.out.find("broken: |s| <= Phi after reaching at ") != std::string::npos);
  REQUIRE(
      run.out.find(
          "warning  Lemma 1 does not hold (wormdrive check prints the details): |tau_l - tau_l_hat| / |tau_l_hat|") !=
      std::string::npos);
  const Hdf5Handle file = open_hdf5(folder / "r.h5");
  REQUIRE(!read_column(file, "controller/sliding_variable").empty());
  for (const char* what : {"controllers", "references"})
    REQUIRE(folder.run({"list", what}).out.find("required") != std::string::npos);
}

}  // namespace wormdrive::test::scenarios_controlled_runs
