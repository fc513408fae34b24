#include "simulation/efficiency_map.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "catch.hpp"
#include "cli/program.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/steady_scenario.hpp"
#include "support.hpp"

// What a drive at constant speed makes of the power that it is given.

namespace wormdrive::test::scenarios_efficiency_map {

namespace {

/// A gear that closes, with friction so low that its load can drive it.
Scenario back_drivable(const std::vector<std::string>& more = {}) {
  std::vector<std::string> set{"mesh.lead_angle_deg=12", "mesh.friction=0.05", "mesh.worm_pitch_radius_m=0.011"};
  const double lead = std::tan(12.0 * unit::degree);
  set.push_back(fmt::format("mesh.gear_pitch_radius_m={}", 60.0 * 0.011 * lead));
  set.insert(set.end(), more.begin(), more.end());
  return load_scenario(shipped("fig09_switching.toml"), set, Purpose::look);
}

const std::vector<double> speeds{-80.0, -1e-3, 0.5, 300.0}, loads{-3.0, -1e-4, 0.2, 7.0};

}  // namespace

TEST_CASE("without bearings the efficiencies are those of a screw with a trapezoidal thread, at any speed and load") {
  const double tangent = std::tan(12.0 * unit::degree), cosine = std::cos(20.0 * unit::degree), mu = 0.05;
  const double driven = tangent * (cosine - mu * tangent) / (cosine * tangent + mu),
               driving = (cosine * tangent - mu) / (tangent * (cosine + mu * tangent));
  for (const OperatingPoint& p : efficiency_map(back_drivable(), speeds, loads)) {
    CAPTURE(p.worm_speed, p.load_torque);
    CHECK(close(p.efficiency, p.worm_speed * p.load_torque < 0.0 ? driven : driving, 1e-12));
  }
}

TEST_CASE("motor and load pay for the loss, whatever effects are on") {
  const Scenario s =
      back_drivable({"effect.worm_viscous.coefficient_Nms_per_rad=1e-4", "effect.gear_coulomb.torque_Nm=0.05",
                     "effect.stribeck={drop=0.01,speed_m_per_s=0.2}", "effect.torque_gain.share=0.1",
                     "effect.actuator_delay.delay_s=0.01", "effect.load_magnitude.share=0.5",
                     "effect.friction_asymmetry.change=0.004"});
  for (const OperatingPoint& p : efficiency_map(s, speeds, loads)) {
    CAPTURE(p.worm_speed, p.load_torque);
    CHECK(close(p.load_power, p.load_torque * p.worm_speed / 60.0, 1e-12));
    CHECK(close(p.motor_power, 1.1 * p.motor_torque * p.worm_speed, 1e-12));
    CHECK(std::abs(p.motor_power + p.load_power - p.loss) < 1e-12 * (std::abs(p.motor_power) + std::abs(p.load_power)));
    CHECK((p.efficiency >= 0.0 && p.efficiency < 1.0));
  }
}

TEST_CASE("with a winding the power is that of its supply, and ends where voltage or current do") {
  const double R = 2.0, k = 0.05, U = 12.0;
  const auto bare = efficiency_map(back_drivable(), speeds, loads);
  // one that gives a voltage, or a current, or a voltage within a current
  for (const std::string amplifier :
       {"", ",current_bandwidth_Hz=400", ",current_limit_A=0.3,limiter_bandwidth_Hz=400"}) {
    const double limit = amplifier.find("limit_A") == std::string::npos ? 1e9 : 0.3;
    const auto wound = efficiency_map(
        back_drivable({"effect.dc_motor={resistance_ohm=2,torque_constant_Nm_per_A=0.05,inductance_H=1e-3,"
                       "supply_voltage_V=12" +
                       amplifier + "}"}),
        speeds, loads);
    int beyond = 0;
    for (std::size_t n = 0; n < bare.size(); ++n) {
      const OperatingPoint &p = bare[n], &q = wound[n];
      const double current = p.motor_torque / k, voltage = R * current + k * p.worm_speed;
      CAPTURE(amplifier, p.worm_speed, p.load_torque, voltage);
      if (std::abs(voltage) > U || std::abs(current) > limit) {
        ++beyond;
        CHECK(std::isnan(q.efficiency));
        continue;
      }
      CHECK(std::abs(q.motor_power - voltage * current) < 1e-12 * U * U / R);  // back-EMF takes most of the voltage
      CHECK(std::abs(q.loss - p.loss - R * current * current) < 1e-12 * U * U / R);
    }
    CHECK((beyond > 0 && beyond < 16));
  }
}

TEST_CASE("a gear that locks itself returns nothing, a worm that locks itself is driven by no torque") {
  const Scenario gear = load_scenario(shipped("fig09_switching.toml"), {}, Purpose::look);
  const auto locked = efficiency_map(gear, speeds, loads);
  for (const OperatingPoint& p : locked) CHECK((p.efficiency > 0.0) == (p.worm_speed * p.load_torque < 0.0));
  const Scenario worm = load_scenario(shipped("fig09_switching.toml"), {"mesh.friction=20"}, Purpose::look);
  for (const OperatingPoint& p : efficiency_map(worm, speeds, loads))
    if (p.worm_speed * p.load_torque < 0.0) CHECK(std::isnan(p.efficiency));
}

TEST_CASE(
    "a brake that opens is open where efficiency and steady torque are asked for, and one that never does is not") {
  const auto seen = [](const std::string& word) {
    const Scenario s = load_scenario(shipped("hatch.toml"), {word}, Purpose::look);
    return std::pair(steady_torque(s, 30.0), efficiency_map(s, {30.0}, {-2.0}).front().efficiency);
  };
  const auto without = seen("effect.holding_brake.on=false"), with = seen("title=x"),
             closed = seen("effect.holding_brake={torque_Nm=0.01}");
  CHECK(with == without);
  CHECK(std::abs(closed.first - without.first - 0.01) < 1e-12);
  CHECK(closed.second < without.second);
}

}  // namespace wormdrive::test::scenarios_efficiency_map
