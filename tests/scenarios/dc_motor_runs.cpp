#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "catch.hpp"
#include "cli/program.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/run_scenario.hpp"
#include "simulation/stepping/stepped_drive.hpp"
#include "support.hpp"

// Scenarios with a motor on a supply: the same events by every method, confirmed by the audit, with all energy found.

namespace wormdrive::test::scenarios_dc_motor_runs {

namespace {

Scenario motor_scenario(std::vector<std::string> words, const std::string& method = "bdf") {
  words.push_back("run.method=" + method);
  return load_scenario(shipped("dc_motor.toml"), words, Purpose::run);
}

void require_same_events(const Trajectory& a, const Trajectory& b, double within) {
  REQUIRE(a.events.size() == b.events.size());
  for (std::size_t k = 0; k < a.events.size(); ++k) {
    REQUIRE(a.events[k].after.mode == b.events[k].after.mode);
    REQUIRE(std::abs(a.events[k].t - b.events[k].t) <= within);
  }
}

}  // namespace

TEST_CASE("random drives with a motor on bristles have the same events by every method, and the audit confirms them") {
  std::mt19937_64 random(230611);
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<double>()(random));
  };
  long events = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const double resistance = between(0.3, 5.0), inductance = between(1e-5, 1e-1), slides = between(0.1, 3.0),
                 torque = between(1e-4, 1e-2);  // slides: angle at which the bristles do [rad]
    std::vector<std::string> words{
        fmt::format("effect.dc_motor.resistance_ohm={}", resistance),
        fmt::format("effect.dc_motor.inductance_H={}", inductance),
        fmt::format("effect.dc_motor.torque_constant_Nm_per_A={}", between(0.01, 0.1)),
        fmt::format("effect.dc_motor.supply_voltage_V={}", between(3.0, 48.0)),
        fmt::format("effect.dc_motor.heat_capacity_J_per_K={}", between(1e-3, 10.0)),
        fmt::format("effect.dc_motor.thermal_resistance_K_per_W={}", between(0.5, 50.0)),
        "effect.dc_motor.temperature_coefficient_per_K=0.0039",
        fmt::format("effect.worm_coulomb.torque_Nm={}", between(1e-4, 1e-2)),
        fmt::format("effect.worm_lugre={{coulomb_torque_Nm={},stiffness_Nm_per_rad={},damping_Nms_per_rad={}}}", torque,
                    torque / slides, trial % 2 == 0 ? 0.0 : between(1e-7, 1e-4)),
        fmt::format("mesh.friction={}", between(0.01, 0.4)),
        fmt::format("motor.torque.amplitude_Nm={}", between(0.01, 1.0)),
        fmt::format("motor.torque.frequency_Hz={}", between(0.3, 30.0)),
        fmt::format("load.torque_Nm={}", between(0.01, 2.0)),
        "run.duration_s=0.5",
        "run.relative_tolerance=1e-12"};
    if (trial % 2 == 1) {  // an amplifier that controls the current, faster than the winding by itself or slower
      words.push_back(
          fmt::format("effect.dc_motor.current_bandwidth_Hz={}", between(0.02, 2.0) * resistance / inductance));
      words.push_back(fmt::format("effect.dc_motor.current_limit_A={}", between(0.5, 20.0)));
    } else if (trial % 4 == 2) {  // one that gives a voltage as long as the current is within a limit
      words.push_back(
          fmt::format("effect.dc_motor.limiter_bandwidth_Hz={}", between(0.2, 20.0) * resistance / inductance));
      words.push_back(fmt::format("effect.dc_motor.current_limit_A={}", between(0.5, 5.0)));
    }
    INFO(fmt::format("{}", fmt::join(words, " ")));
    const Trajectory a = simulate_scenario(motor_scenario(words)),
                     b = simulate_scenario(motor_scenario(words, "adams"));
    require_same_events(a, b, 1e-7);
    if (inductance / resistance > 1e-4) {  // by series a faster winding takes too long for a test
      std::vector<std::string> by_series = words;
      by_series.emplace_back("run.solver=taylor");
      require_same_events(a, simulate_scenario(motor_scenario(by_series)), 1e-7);
    }
    events += static_cast<long>(a.events.size());
    const RunSummary audited = run_scenario(motor_scenario(words), {.audit = true});
    REQUIRE(audited.audit->findings.empty());
  }
  REQUIRE(events > 50);
}

TEST_CASE("an audit follows windings that settle within microseconds or picoseconds, and confirms the run") {
  for (const std::string file : {"dc_motor.toml", "current_loop.toml"})
    for (const char* inductance : {"1e-6", "1e-8", "1e-10", "1e-12"}) {
      INFO(file << ", " << inductance << " H");
      const Scenario scenario = load_scenario(
          shipped(file), {std::string("effect.dc_motor.inductance_H=") + inductance, "run.duration_s=0.4"},
          Purpose::run);
      const AuditReport report = *run_scenario(scenario, {.audit = true}).audit;
      CHECK(report.events > 0);
      CHECK(report.findings.empty());
      CHECK(report.largest_angle_error < 1e-7);
      CHECK(report.largest_speed_error < 1e-6);
    }
}

TEST_CASE("without inductance both solvers have the same events, also where the supply cuts the command") {
  const std::vector<std::string> words{"effect.dc_motor.inductance_H=0"};
  std::vector<std::string> by_taylor = words;
  by_taylor.push_back("run.solver=taylor");
  const Trajectory a = simulate_scenario(motor_scenario(words)), b = simulate_scenario(motor_scenario(by_taylor));
  REQUIRE(a.events.size() > 5);
  require_same_events(a, b, 1e-9);
  double most = 0.0;
  for (const Row& row : b.rows) most = std::max(most, std::abs(row.at.winding->voltage));
  REQUIRE(most == 12.0);
}

TEST_CASE("the energy from the supply is found in the load, in heat and in what moves, to 1e-9") {
  const double closing_angle = GearMesh<double>(table1()).closing_lead_angle() / unit::degree;
  for (const std::string motor : {"inductance_H=0", "inductance_H=0.0015", "inductance_H=0.02",
                                  "heat_capacity_J_per_K=2 effect.dc_motor.temperature_coefficient_per_K=0.0039"}) {
    std::vector<std::string> words{fmt::format("mesh.lead_angle_deg={}", closing_angle)};
    std::istringstream stated("effect.dc_motor." + motor);
    for (std::string word; stated >> word;) words.push_back(word);
    const AuditReport report = *run_scenario(motor_scenario(words), {.audit = true}).audit;
    INFO(motor);
    REQUIRE(report.findings.empty());
    REQUIRE(report.work > 1.0);
    REQUIRE(std::abs(report.energy_error) <= 1e-9 * report.work);
  }
}

TEST_CASE("a drive with a motor that is stepped goes where its run goes, and comes back to a snapshot") {
  const Scenario scenario = load_scenario(
      shipped("dc_motor.toml"), {"motor.torque={kind=\"constant\",torque_Nm=0.2}", "run.duration_s=0.5"}, Purpose::run);
  const Observation end = run_scenario(scenario).end;
  const auto stepped = make_stepped_drive(scenario);
  stepped->step(0.2, 0.25);
  const std::vector<double> half = stepped->snapshot();
  stepped->step(0.2, 0.25);
  const StepState first = stepped->state();
  REQUIRE(std::abs(first.at.theta_g - end.theta_g) <= 1e-10);
  REQUIRE(std::abs(first.at.winding->current - end.winding->current) <= 1e-9);
  stepped->restore(half);
  stepped->step(0.2, 0.25);
  REQUIRE(stepped->state().at.theta_g == first.at.theta_g);
  REQUIRE(stepped->state().at.winding->current == first.at.winding->current);
}

}  // namespace wormdrive::test::scenarios_dc_motor_runs
