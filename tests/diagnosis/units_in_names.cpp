#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "catch.hpp"
#include "cli/program.hpp"
#include "description/diagnostics.hpp"
#include "diagnosis/data/recorded_table.hpp"
#include "numbers.hpp"
#include "simulation/load_scenario.hpp"
#include "support.hpp"

// A log whose columns say their units at the end of their names.

namespace wormdrive::test::diagnosis_units_in_names {

namespace {

struct Columns {
  const char *time, *torque, *angle, *speed;
  double second, newton_metre, radian, radian_per_second;  ///< one of these in the units of the names
};

/// Three rows, written with 17 digits.
std::string csv(const Columns& c) {
  std::string text = fmt::format("{},{},{},{}\n", c.time, c.torque, c.angle, c.speed);
  for (const double k : {1.0, 2.0, 3.0})
    text += fmt::format("{:.17g},{:.17g},{:.17g},{:.17g}\n", 0.001 * k * c.second, 0.2 * k * c.newton_metre,
                        0.7 * k * c.radian, 3.0 * k * c.radian_per_second);
  return text;
}

constexpr double turn = 2.0 * std::numbers::pi;

}  // namespace

TEST_CASE("columns whose names end with a known unit are read in it") {
  const Folder folder;
  const Scenario scenario = load_scenario(shipped("example_bench.toml"), {}, Purpose::look);
  for (const Columns& c :
       {Columns{"time_s", "motor_torque_Nm", "gear_angle_rad", "gear_speed_rad_per_s", 1.0, 1.0, 1.0, 1.0},
        Columns{"time_ms", "motor_torque_mNm", "gear_angle_mrad", "gear_speed_rpm", 1e3, 1e3, 1e3, 60.0 / turn},
        Columns{"time_us", "motor_torque_Ncm", "gear_angle_deg", "gear_speed_deg_per_s", 1e6, 100.0, 360.0 / turn,
                360.0 / turn},
        Columns{"time_min", "motor_torque_Nmm", "gear_angle_degrees", "gear_speed_mrad_per_s", 1.0 / 60.0, 1e3,
                360.0 / turn, 1e3}}) {
    CAPTURE(c.torque);
    folder.write("log.csv", csv(c));
    const RecordedTable table = read_recorded_table(folder / "log.csv", scenario);
    for (std::size_t k = 0; k < 3; ++k) {
      const double n = static_cast<double>(k + 1);
      CHECK(close(table.time.values[k], 0.001 * n, 1e-14));
      CHECK(close(table.torque.values[k], 0.2 * n, 1e-14));
      CHECK(close(table.angle.values[k], 0.7 * n, 1e-14));
      CHECK(close(table.speed.values[k], 3.0 * n, 1e-14));
    }
  }
}

TEST_CASE("a column whose name ends with no known unit is rejected, not read as if it were in the usual one") {
  const Folder folder;
  const Scenario scenario = load_scenario(shipped("example_bench.toml"), {}, Purpose::look);
  folder.write("log.csv",
               csv({"time_s", "motor_torque_lbft", "gear_angle_rad", "gear_speed_rad_per_s", 1.0, 1.0, 1.0, 1.0}));
  try {
    read_recorded_table(folder / "log.csv", scenario);
    FAIL("it was read");
  } catch (const InputFault& fault) {
    CHECK(std::string(fault.what()) ==
          (folder / "log.csv") +
              ":1: error: no column 'motor_torque_Nm'; the header line names time_s, motor_torque_lbft, "
              "gear_angle_rad, gear_speed_rad_per_s; 'lbft' is no known unit of a quantity in N m");
  }
}

}  // namespace wormdrive::test::diagnosis_units_in_names
