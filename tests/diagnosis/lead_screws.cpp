#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "catch.hpp"
#include "cli/program.hpp"
#include "diagnosis/answers.hpp"
#include "diagnosis/points/point_diagnosis.hpp"
#include "diagnosis/points/steady_points.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "simulation/load_scenario.hpp"
#include "support.hpp"

// Two measured lead screws: Mablekos-Alexiou, da Cruz, Bergeles, IEEE T-RO 37(4), 2021, drives no. 1 and no. 2. A nut
// is a gear of radius 1 m.

namespace wormdrive::test::diagnosis_lead_screws {

namespace {

/// A screw of the paper with friction of its teeth alone.
Scenario screw(double nut_mass, double friction) {
  std::vector<std::string> changes{"mesh.ratio=3141.59",
                                   "mesh.lead_angle_deg=3.0368",
                                   "mesh.pressure_angle_deg=14.979",
                                   "mesh.worm_pitch_radius_m=0.0055",
                                   "mesh.gear_pitch_radius_m=1",
                                   "mesh.worm_inertia_kgm2=2.186e-6",
                                   "load.torque_Nm=0.942",
                                   fmt::format("mesh.gear_inertia_kgm2={}", nut_mass),
                                   fmt::format("mesh.friction={}", friction)};
  for (const char* const effect : {"worm_coulomb", "worm_viscous", "gear_coulomb"})
    changes.push_back(fmt::format("effect.{}.on=false", effect));
  return load_scenario(shipped("measured_worm_drive.toml"), changes, Purpose::look);
}

struct Found {
  Diagnosis diagnosis;
  double rms;  ///< of torques, each by the fit of the half that does not hold it [N m]
};

std::optional<Found> diagnosed(const char* file, const Scenario& scenario) {
  const auto path = reference_path(fmt::format("lead_screws/{}", file));
  if (!path) return std::nullopt;
  const std::vector<SpeedTorqueRecord> records = read_speed_torque_records(*path);
  const TorquePoints points = steady_points(records, scenario);
  Found found{diagnose(scenario, points, steady_points_at_two_loads(records, scenario, 1.884)), 0.0};
  const PredictedTorques& torques = found.diagnosis.torques;
  for (std::size_t k = 0; k < torques.measured.size(); ++k)
    found.rms += std::pow(torques.measured[k] - torques.after[k], 2) / static_cast<double>(torques.measured.size());
  found.rms = std::sqrt(found.rms);
  return found;
}

}  // namespace

TEST_CASE("of a plain lead screw Coulomb, viscous and Stribeck friction are named, not a friction that no teeth have",
          "[reference][slow]") {
  for (const double friction : {0.2, 0.27}) {
    const auto found = diagnosed("drive1_steady.csv", screw(0.276, friction));
    if (!found) return;
    INFO("stated friction " << friction << ": " << found->diagnosis.sentence);
    CHECK(found->rms <= 0.045e-3);
    CHECK(found->diagnosis.causes.size() == 3);
    for (const char* const effect : {"worm_coulomb", "worm_viscous", "stribeck"})
      CHECK(cause(found->diagnosis, effect));
    for (const RankedCandidate& ranked : found->diagnosis.ranking)
      if (ranked.effect.effect == "agma")
        CHECK(ranked.outcome == "the friction of the teeth would reach 0.88: no teeth rub so");
  }
}

TEST_CASE("what a diagnosis names can be simulated: friction stays between zero and what teeth can have",
          "[reference][slow]") {
  const Scenario scenario = screw(0.276, 0.15);  // less than the screw has: its fall would end below zero
  const auto found = diagnosed("drive1_steady.csv", scenario);
  if (!found) return;
  INFO(found->diagnosis.sentence);
  const double mu = std::get<MeshParameters<double>>(found->diagnosis.extended.mesh).mu;
  const FrictionRange range = found->diagnosis.extended.effects.friction_range({mu, mu}, 1.0);
  CHECK(range.low >= 0.0);
  CHECK(range.high <= rules::highest_friction);
  for (const std::string& remark : found->diagnosis.remarks) CHECK(remark.find("cannot be run") == std::string::npos);
}

TEST_CASE("of a preloaded lead screw the Coulomb friction is found that its preload makes", "[reference][slow]") {
  const auto found = diagnosed("drive2_steady.csv", screw(0.326, 0.2));
  if (!found) return;
  INFO(found->diagnosis.sentence);
  REQUIRE(cause(found->diagnosis, "worm_coulomb"));
  CHECK(std::abs(cause(found->diagnosis, "worm_coulomb")->parameters.at(0).value - 3.7e-3) <= 0.15e-3);
}

}  // namespace wormdrive::test::diagnosis_lead_screws
