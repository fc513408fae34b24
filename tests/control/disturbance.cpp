#include "control/disturbance.hpp"

#include <cmath>
#include <map>
#include <vector>

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "cli/bad_input.hpp"
#include "compliant_drives.hpp"
#include "control/closed_loop.hpp"

// The random torque acts on the worm's shaft beside the motor: nothing of the actuator touches it.

namespace wormdrive::test::control_disturbance {

namespace {

constexpr double period = 1e-3, J = 1e-3;
constexpr int samples = 200;
const DisturbanceSettings random_torque{.deviation = 0.02, .time_constant = 0.004, .seed = 7};

/// Wants more than the motor gives, to and fro.
const auto greedy = [](const Measurement& m) { return ControlSignals{.torque = m.t < 0.1 ? 0.09 : -0.09}; };

/// The speed of a shaft after each sample, and what disturbs it from there on.
struct EventSequence {
  std::map<long, double> speed;
  std::vector<ControlRecord> records;
};
template <class System>
EventSequence course(System system, By by, const DisturbanceSettings& disturbance, int speed_in_state = 1) {
  EventSequence made;
  ClosedLoop loop(greedy, Reference{}, SensorSettings{}, SamplingSettings{.period = period}, disturbance,
                  [&](const ControlRecord& r) { made.records.push_back(r); });
  const auto r = run(std::move(system), Timetable(0, samples * period, period, {period, 0.0}), {}, tight(by), loop);
  for (const auto& row : r.rows) {
    const long k = std::lround(row.now.t / period);
    if (std::abs(row.now.t - static_cast<double>(k) * period) < 1e-9) made.speed[k] = row.now.x[speed_in_state];
  }
  return made;
}

WormDrive<double, TimedLoad> wheel(const Effects<double>& on) {
  return {GearMesh<double>::without_teeth(J), make_load(constant(0.0)), on, {}};
}

}  // namespace

TEST_CASE("whatever the actuator does, a disturbance of a free inertia adds its integral and nothing else") {
  const Effects<double> actuators[] = {
      effects(),
      effects(TorqueSaturation<double>{0.04}),
      effects(TorqueGain<double>{1.0}),
      effects(ActuatorLag<double>{0.01}),
      effects(ActuatorDelay<double>{0.0023}),
      effects(TorqueSaturation<double>{0.04}, TorqueGain<double>{-0.6}, ActuatorLag<double>{0.003},
              ActuatorDelay<double>{0.0017}, TorqueOffset<double>{0.01})};
  for (const Effects<double>& on : actuators)
    for (const By by : every_solver) {
      const EventSequence calm = course(wheel(on), by, {}), disturbed = course(wheel(on), by, random_torque);
      double sum = 0.0, largest = 0.0;
      for (int k = 0; k < samples; ++k) {
        REQUIRE(disturbed.records[k].applied == calm.records[k].applied);
        REQUIRE(calm.records[k].disturbance == 0.0);
        REQUIRE(std::abs(disturbed.speed.at(k) - calm.speed.at(k) - sum) <= 1e-9);
        sum += disturbed.records[k].disturbance * period / J;
        largest = std::max(largest, std::abs(sum));
      }
      REQUIRE(largest > 0.1);
    }
}

TEST_CASE("a disturbance turns the worm of elastic teeth alone, as long as they are apart") {
  const ToothContact<double> wide{HuntCrossley<double>{1e6, 10.0}, 10.0};
  const MeshParameters<double> p = table1(0.0);
  const auto d = compliant(p, constant(0.0), {}, wide, effects(TorqueSaturation<double>{0.01}));
  const DisturbanceSettings gentle{.deviation = 1e-4, .time_constant = 0.0, .seed = 3};
  const EventSequence calm = course(d, bdf, {}), disturbed = course(d, bdf, gentle);
  double sum = 0.0;
  for (int k = 0; k < samples; ++k) {
    REQUIRE(std::abs(disturbed.speed.at(k) - calm.speed.at(k) - sum) <= 1e-8);
    sum += disturbed.records[k].disturbance * period / p.Jw;
  }
  REQUIRE(std::abs(sum) > 1e-3);
}

TEST_CASE("a result tells the motor's torque from what disturbs its shaft, an audit finds both again") {
  const Folder folder;
  const std::string motor = "[motor.torque]\nkind = \"constant\"\ntorque_Nm = -0.05\n";
  folder.write("s.toml",
               edited(good_but(motor,
                               "[controller]\nkind = \"open_loop\"\nsample_time_s = 1e-3\n[controller.torque]\n"
                               "kind = \"constant\"\ntorque_Nm = -0.04\n[disturbance]\ndeviation_Nm = 0.02\n"
                               "[effect]\ntorque_saturation.limit_Nm = 0.04\ntorque_gain.share = 1\n"),
                      "duration_s = 0.01", "duration_s = 0.5"));
  for (const std::string solver : {"cvode", "taylor"}) {
    const Outcome outcome =
        folder.run({"run", "s.toml", "-o", solver + ".h5", "--audit", "--set", "run.solver=" + solver, "--json"});
    INFO(outcome.err);
    REQUIRE(outcome.exit == 0);
    const auto json = nlohmann::json::parse(outcome.out);
    CHECK(json["audit"]["missed"] == 0);
    CHECK(json["audit"]["not_confirmed"] == 0);
    CHECK(json["audit"]["largest_angle_error"] < 1e-8);
    const Hdf5Handle file = open_hdf5(folder / (solver + ".h5"));
    double squares = 0.0;
    const auto disturbance = read_column(file, "controller/disturbance_torque");
    REQUIRE(disturbance.size() == 500);
    for (const double torque : disturbance) squares += torque * torque / 500.0;
    CHECK(close(std::sqrt(squares), 0.02, 0.1));
    for (const double torque : read_column(file, "controller/applied_torque")) REQUIRE(torque == -0.04);
    for (const double torque : read_column(file, "trajectory/motor_torque")) REQUIRE(torque == -0.08);
  }
}

TEST_CASE("without a reference there is no tracking error to tell", "[slow]") {
  const Folder folder;
  const std::string motor = "[motor.torque]\nkind = \"constant\"\ntorque_Nm = -0.05\n";
  const std::string law =
      "[controller]\nkind = \"open_loop\"\nsample_time_s = 1e-3\n[controller.torque]\nkind = \"constant\"\n"
      "torque_Nm = -0.04\n";
  const std::string reference = "[reference]\nkind = \"step\"\nangle_rad = 0.1\ntime_s = 0\n";
  for (const bool follows : {false, true}) {
    folder.write("s.toml", good_but(motor, law + (follows ? reference : "")));
    const Outcome outcome = folder.run({"run", "s.toml", "-o", "r.h5"});
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.exit == 0);
    CHECK((outcome.out.find("tracking") != std::string::npos) == follows);
    CHECK(outcome.out.find("torque 0.04 N m rms, 0.04 peak") != std::string::npos);
    const auto json = nlohmann::json::parse(folder.run({"run", "s.toml", "-o", "r.h5", "--json"}).out);
    CHECK(json["control"]["metrics"].contains("error_rms") == follows);
    CHECK(json["control"]["metrics"]["torque_peak"]["value"] == 0.04);
    REQUIRE(folder.run({"report", "r.h5", "-o", "r.html"}).exit == 0);
    CHECK((folder.read("r.html").find("tracking_error") != std::string::npos) == follows);
    CHECK(folder.run({"plot", "r.h5"}).exit == 0);
  }
}

}  // namespace wormdrive::test::control_disturbance
