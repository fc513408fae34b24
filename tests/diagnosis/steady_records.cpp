#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <set>

#include <fmt/format.h>

#include "catch.hpp"
#include "cli/program.hpp"
#include "core/steady.hpp"
#include "description/build.hpp"
#include "diagnosis/points/point_diagnosis.hpp"
#include "diagnosis/points/steady_points.hpp"
#include "simulation/load_scenario.hpp"
#include "some_of.hpp"
#include "support.hpp"

// Records at constant speed as data of a diagnosis: the measured drive, and drives with hidden friction.

namespace wormdrive::test::diagnosis_steady_records {

namespace {

/// The measured drive with friction of the mesh alone.
Scenario mesh_friction_only() {
  return load_scenario(shipped("measured_worm_drive.toml"),
                       {"effect.worm_coulomb.on=false", "effect.worm_viscous.on=false", "effect.gear_coulomb.on=false"},
                       Purpose::look);
}

std::set<std::string> ids(const std::vector<EstimatedEffect>& effects) {
  std::set<std::string> all;
  for (const EstimatedEffect& e : effects) all.insert(e.effect);
  return all;
}

/// Torques of a drive whose effects are hidden, with noise; both from a seed.
std::vector<SpeedTorqueRecord> hidden(const Scenario& truth, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> error(0.0, noise);
  std::vector<SpeedTorqueRecord> records;
  for (const double speed : {0.1, 0.2, 0.4, 0.8, 1.3, 2.1, 3.1, 4.2, 5.2, 6.3, 8.4, 10.5, 12.6, 14.7, 16.8, 18.8, 20.9})
    for (const double w : {-speed, speed}) {
      auto drive = make_drive(truth);
      drive.enter(0.0);
      const double torque = steady_torque(drive, w, 0.0, 0.0);
      records.push_back({fmt::format("{}", w), w, torque + error(random), 500, {}});
    }
  return records;
}

Diagnosis diagnosed(const std::vector<SpeedTorqueRecord>& records, const Scenario& scenario) {
  const TorquePoints points = steady_points(records, scenario);
  return diagnose(scenario, points, steady_points_at_two_loads(records, scenario, 2.0 * points.load_torque.front()));
}

}  // namespace

TEST_CASE("of the measured drive worm viscous and Stribeck friction are named, the levels are one class",
          "[reference][slow]") {
  const auto path = reference_path("worm_drive/steady_speed.csv");
  if (!path) return;
  const Diagnosis d = diagnosed(read_speed_torque_records(*path), mesh_friction_only());
  INFO(d.sentence);
  CHECK(d.verdict == Verdict::ambiguous);
  const std::set<std::string> causes = ids(d.causes);
  std::set<std::string> level(d.classes.at(0).begin(), d.classes.at(0).end());
  for (const char* const sure : {"worm_viscous", "stribeck"}) {
    CHECK(causes.count(sure) == 1);
    CHECK(level.count(sure) == 0);
  }
  for (const char* const member : {"mesh_friction", "worm_coulomb", "gear_coulomb", "load_magnitude"})
    CHECK(level.count(member) == 1);
  for (const std::string& cause : causes)  // nothing else is claimed
    CHECK((cause == "worm_viscous" || cause == "stribeck" || level.count(cause) == 1));
  REQUIRE(d.experiment);
  CHECK(d.experiment_reason.find("under a load of 0.0377 N m as well") != std::string::npos);

  // again from the torques: both halves, each judged by the fit of the other
  double squares[2] = {0.0, 0.0};
  const std::vector<int> half = steady_points(read_speed_torque_records(*path), mesh_friction_only()).half;
  for (std::size_t k = 0; k < half.size(); ++k)
    squares[half[k]] += std::pow(d.torques.measured[k] - d.torques.after[k], 2);
  REQUIRE(half.size() == 46);
  CHECK(std::sqrt(squares[0] / 23) <= 0.045e-3);
  CHECK(std::sqrt(squares[1] / 23) <= 0.045e-3);
  CHECK(d.prediction.at(0).after_low < d.prediction[0].after);
  CHECK(d.prediction[0].after < d.prediction[0].after_high);
}

TEST_CASE("friction that is stated far too low is told by its level, not by one that rises with the speed",
          "[reference][slow]") {
  const auto path = reference_path("worm_drive/steady_speed.csv");
  if (!path) return;
  Scenario scenario = mesh_friction_only();
  std::get<MeshParameters<double>>(scenario.mesh).mu = 0.04;  // a third of what the drive has
  const Diagnosis d = diagnosed(read_speed_torque_records(*path), scenario);
  INFO(d.sentence);
  for (const EstimatedEffect& cause : d.causes)
    if (cause.effect == "stribeck") CHECK(cause.parameters.at(0).value > 0.0);
  bool told = false;
  for (const std::vector<std::string>& one_class : d.classes)
    told = told || std::find(one_class.begin(), one_class.end(), "mesh_friction") != one_class.end();
  CHECK(told);
}

TEST_CASE("records of the scenario's own drive are adequate, whatever the noise", "[slow][cases]") {
  const Scenario scenario = mesh_friction_only();
  for (const unsigned seed : some_of(std::vector{1U, 2U, 3U, 4U}, 2)) {
    const Diagnosis d = diagnosed(hidden(scenario, 2e-5, seed), scenario);
    INFO("seed " << seed << ": " << d.sentence);
    CHECK(d.verdict == Verdict::adequate);
    CHECK(d.causes.empty());
    CHECK(d.sentence == "The simulation contains every effect that these data show.");
  }
}

TEST_CASE("hidden friction over the speed is named, with its size in the interval", "[slow][cases]") {
  const Scenario scenario = mesh_friction_only();
  int covered = 0, all = 0;
  for (const auto& [effect, field, size] : some_of(std::vector{std::tuple{"stribeck", "drop", 0.03},
                                                               {"worm_viscous", "coefficient", 1.2e-5},
                                                               {"gear_viscous", "coefficient", 0.03}}))
    for (const unsigned seed : {11U, 12U}) {
      Scenario truth = scenario;
      set_field(truth.effects, {effect, field, size});
      if (std::string(effect) == "stribeck") set_field(truth.effects, {effect, "speed", 0.01});
      const Diagnosis d = diagnosed(hidden(truth, 2e-5, seed), scenario);
      INFO(effect << ", seed " << seed << ": " << d.sentence);
      REQUIRE(d.causes.size() == 1);
      REQUIRE(d.causes[0].effect == effect);
      const Estimate& e = d.causes[0].parameters.at(0);
      CHECK(std::abs(e.value - size) <= 0.1 * size);
      covered += e.low <= size && size <= e.high ? 1 : 0;
      ++all;
      CHECK(field_of(d.extended.effects, effect, field).value == e.value);
    }
  CHECK(covered >= (all == 6 ? 4 : 1));  // of intervals of 95 %: fewer in one of 400 suites
}

TEST_CASE("an effect on the level of friction is told as one of its class, for one payload tells no more",
          "[slow][cases]") {
  const Scenario scenario = mesh_friction_only();
  for (const auto& [effect, field, size] : some_of(std::vector{std::tuple{"worm_coulomb", "torque", 4e-4},
                                                               {"mesh_friction", "change", 0.05},
                                                               {"load_magnitude", "share", 0.3}})) {
    Scenario truth = scenario;
    set_field(truth.effects, {effect, field, size});
    const Diagnosis d = diagnosed(hidden(truth, 2e-5, 13), scenario);
    INFO(effect << ": " << d.sentence);
    CHECK(d.verdict == Verdict::ambiguous);
    CHECK(std::count(d.classes.at(0).begin(), d.classes.at(0).end(), effect) == 1);
    CHECK(std::count(d.classes.at(0).begin(), d.classes.at(0).end(), "worm_viscous") == 0);
    CHECK(d.prediction.at(0).after < 0.2 * d.prediction[0].before);
  }
}

TEST_CASE("what records at constant speed cannot show is told", "[slow]") {
  const Scenario scenario = mesh_friction_only();
  const Diagnosis d = diagnosed(hidden(scenario, 2e-5, 7), scenario);
  std::set<std::string> unseen;
  for (const Visibility& v : d.certificate) {
    if (!v.observable) unseen.insert(v.effect);
    CHECK((!v.observable || v.nameable >= v.detectable));
  }
  for (const char* const effect : {"backlash", "worm_inertia", "gear_inertia", "encoder_offset", "actuator_lag"})
    CHECK(unseen.count(effect) == 1);
  for (const char* const effect : {"worm_viscous", "stribeck", "mesh_friction", "gear_coulomb"})
    CHECK(unseen.count(effect) == 0);
}

}  // namespace wormdrive::test::diagnosis_steady_records
