// Drives that are stepped together: each gets the bits that it would get alone.
#include <random>

#include "catch.hpp"
#include "description/diagnostics.hpp"
#include "events/simulation_failure.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/stepping/stepped_drives.hpp"

namespace wormdrive::test::stepping_together {
namespace {

Scenario shipped(const std::string& name, const std::vector<std::string>& overrides) {
  return load_scenario(std::string(WORMDRIVE_SCENARIOS) + "/" + name, overrides, Purpose::run);
}

/// Drives of fig. 9 with friction, load and inertia of their own.
std::vector<Scenario> fleet(int count, const std::vector<std::string>& overrides) {
  std::vector<Scenario> list;
  for (int k = 0; k < count; ++k) {
    std::vector<std::string> own = overrides;
    own.push_back("mesh.friction=" + std::to_string(0.20 + 0.003 * k));
    own.push_back("load.torque_Nm=" + std::to_string(0.01 * (k % 7 - 3)));
    own.push_back("initial.gear_angle_rad=" + std::to_string(0.4 * k));
    list.push_back(shipped("fig09_switching.toml", own));
  }
  return list;
}

/// Steps all together and each alone, and compares everything. Returns the events.
long compare(const std::vector<Scenario>& scenarios, LaneKind kind, bool lanes) {
  SteppedDrives together(scenarios, kind);
  CHECK(together.in_lanes() == lanes);
  std::vector<std::unique_ptr<SteppedDrive>> alone;
  for (const Scenario& scenario : scenarios) alone.push_back(make_stepped_drive(scenario));
  std::mt19937 random(5);
  std::vector<double> torques(scenarios.size());
  long events = 0;
  for (int step = 0; step < 120; ++step) {
    for (double& torque : torques)
      if (random() % 3 == 0) torque = 0.16 * (static_cast<double>(random() % 1001) / 1000.0 - 0.5);
    const double dt = step < 100 ? 0.004 : 0.0071;
    together.step(torques, dt);
    for (std::size_t k = 0; k < alone.size(); ++k) {
      alone[k]->step(torques[k], dt);
      const StepPlace place = alone[k]->place();
      INFO("drive " << k << ", step " << step);
      REQUIRE(together.time()[k] == alone[k]->time());
      REQUIRE(together.gear_angle()[k] == place.theta_g);
      REQUIRE(together.gear_speed()[k] == place.omega_g);
      REQUIRE(together.motion()[k] == sign(place.mode.motion));
      REQUIRE(together.flank()[k] == sign(place.mode.flank));
    }
  }
  for (std::size_t k = 0; k < alone.size(); ++k) {
    CHECK(together.snapshot(k) == alone[k]->snapshot());
    CHECK(together.state(k).at.normal_force == alone[k]->state().at.normal_force);
    for (const long count : together.events(k)) events += count;
  }
  return events;
}

}  // namespace

TEST_CASE("stepping together: lanes of every width give the bits of drives alone", "[stepping_together]") {
  for (const LaneKind kind : lane_kinds) {
    if (!is_available(kind)) continue;
    INFO("lanes: " << lanes_of(kind));
    CHECK(compare(fleet(19, {"run.solver=taylor"}), kind, true) > 300);
    CHECK(compare(fleet(5, {"run.solver=taylor", "effect.worm_coulomb.torque_Nm=0.003",
                            "effect.gear_coulomb.torque_Nm=0.01"}),
                  kind, true) > 50);
  }
}

TEST_CASE("stepping together: drives that fit no lane go one after the other", "[stepping_together]") {
  CHECK(compare(fleet(3, {}), widest_lanes(), false) > 30);
  CHECK(compare(fleet(3, {"run.solver=taylor", "effect.actuator_lag.time_constant_s=0.01"}), widest_lanes(), false) >
        30);
}

TEST_CASE("stepping together: one starts again while the others go on", "[stepping_together]") {
  const auto scenarios = fleet(9, {"run.solver=taylor"});
  SteppedDrives drives(scenarios);
  const std::vector<double> torques(9, 0.06);
  for (int k = 0; k < 10; ++k) drives.step(torques, 0.01);
  drives.reset(4);
  CHECK(drives.time()[4] == 0.0);
  CHECK(drives.gear_angle()[4] == scenarios[4].initial.theta_g);
  CHECK(drives.time()[3] == 0.1);
  const auto fresh = make_stepped_drive(scenarios[4]);
  for (int k = 0; k < 25; ++k) {
    drives.step(torques, 0.01);
    fresh->step(0.06, 0.01);
  }
  CHECK(drives.time()[4] == Catch::Approx(0.25).epsilon(1e-14));
  CHECK(drives.gear_angle()[4] == Catch::Approx(fresh->place().theta_g).epsilon(1e-13));
  drives.reset();
  for (const double t : drives.time()) CHECK(t == 0.0);
}

TEST_CASE("stepping together: all go back to their snapshots, to the same bits", "[stepping_together]") {
  for (const std::string solver : {"taylor", "cvode"}) {
    const auto scenarios = fleet(5, {"run.solver=" + solver});
    SteppedDrives drives(scenarios), others(scenarios);
    const std::vector<double> torques{0.06, -0.06, 0.0, 0.03, 0.08};
    for (int k = 0; k < 7; ++k) drives.step(torques, 0.01);
    std::vector<std::vector<double>> kept;
    for (std::size_t k = 0; k < 5; ++k) kept.push_back(drives.snapshot(k));
    others.step(torques, 0.7);
    others.restore(kept);
    for (int k = 0; k < 30; ++k) {
      drives.step(torques, 0.01);
      others.step(torques, 0.01);
    }
    for (std::size_t k = 0; k < 5; ++k) CHECK(others.snapshot(k) == drives.snapshot(k));
  }
}

TEST_CASE("stepping together: what is wrong with a step is said before any drive has moved", "[stepping_together]") {
  SteppedDrives drives(fleet(2, {"run.solver=taylor"}));
  CHECK_THROWS_WITH(drives.step(std::vector<double>{0.0}, 0.01),
                    "step: error: 1 torques for 2 drives; state one for each");
  CHECK_THROWS_WITH(drives.step(std::vector<double>{0.0, std::nan("")}, 0.01),
                    "step: error: torque[1] = nan must be a finite number");
  CHECK_THROWS_WITH(drives.step(std::vector<double>{0.0, 0.0}, -1.0),
                    "step: error: dt = -1 s must be a finite number greater than 0");
  CHECK(drives.time()[0] == 0.0);
}

}  // namespace wormdrive::test::stepping_together
