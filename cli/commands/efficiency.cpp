#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/describe/drive.hpp"
#include "cli/shell_words.hpp"
#include "description/diagnostics.hpp"
#include "description/toml/write_scenario.hpp"
#include "output/hdf5/table.hpp"
#include "simulation/efficiency_map.hpp"
#include "simulation/load_scenario.hpp"

namespace wormdrive {
namespace {

/// From -most to most in even steps, without 0: half a step on either side of it.
std::vector<double> both_ways(double most, int points) {
  std::vector<double> values;
  for (int k = -points; k < points; ++k) values.push_back(most * (k + 0.5) / (points - 0.5));
  return values;
}

struct Map {
  std::vector<double> speeds, loads;
  std::vector<OperatingPoint> points;  ///< speed by speed

  const OperatingPoint& at(std::size_t speed, std::size_t load) const { return points[speed * loads.size() + load]; }
};

/// The best of those that drive the load, or of those that the load drives; none if none does. Of equal ones it is the
/// fastest forward.
const OperatingPoint* best(const Map& map, bool load_drives) {
  constexpr double more = 1.0 + 1e-9;  // than rounding
  const OperatingPoint* found = nullptr;
  for (auto point = map.points.rbegin(); point != map.points.rend(); ++point)
    if ((point->load_power > 0.0) == load_drives && point->efficiency > (found ? more * found->efficiency : 0.0))
      found = &*point;
  return found;
}

void write(const std::string& output, const Scenario& scenario, const Map& map, const EfficiencyOptions& options) {
  PartFile file(output, "efficiency", options.replace);
  write_provenance(file.file(), {"efficiency", scenario.title, to_toml(scenario), options.scenario.command_line});
  std::vector<std::vector<double>> columns(7);
  for (const OperatingPoint& p : map.points) {
    std::size_t column = 0;
    for (const double value :
         {p.worm_speed, p.load_torque, p.motor_torque, p.motor_power, p.load_power, p.loss, p.efficiency})
      columns[column++].push_back(value);
  }
  GrowingTable(file.file(), "efficiency",
               {{"worm_speed", "rad/s", "worm speed"},
                {"load_torque", "N m", "load torque tau_l"},
                {"motor_torque", "N m", "motor torque that keeps the speed"},
                {"motor_power", "W", "power into the drive from the motor, or from the supply of its winding"},
                {"load_power", "W", "power into the drive from the load"},
                {"loss", "W", "power that friction and winding take"},
                {"efficiency", "1", "power out of the drive over power into it"}})
      .append(columns);
  file.finish();
}

nlohmann::json as_json(const Scenario& scenario, const Map& map) {
  nlohmann::json efficiency = nlohmann::json::array(), torque = nlohmann::json::array();
  const auto number = [](double value) { return std::isnan(value) ? nlohmann::json() : nlohmann::json(value); };
  for (std::size_t s = 0; s < map.speeds.size(); ++s) {
    nlohmann::json shares = nlohmann::json::array(), torques = nlohmann::json::array();
    for (std::size_t l = 0; l < map.loads.size(); ++l) {
      shares.push_back(number(map.at(s, l).efficiency));
      torques.push_back(number(map.at(s, l).motor_torque));
    }
    efficiency.push_back(shares);
    torque.push_back(torques);
  }
  return {{"title", scenario.title},
          {"worm_speed_rad_per_s", map.speeds},
          {"load_torque_Nm", map.loads},
          {"motor_torque_Nm", torque},
          {"efficiency", efficiency}};
}

/// Five loads of each sign over up to six speeds forward: what fits on a screen; the file has them all.
void print_table(const Map& map) {
  const std::size_t rows = map.loads.size(), first = map.speeds.size() / 2, columns = map.speeds.size() - first;
  const auto spread = [](std::size_t count, std::size_t shown, std::size_t k) {
    return shown < 2 ? count - 1 : k * (count - 1) / (shown - 1);
  };
  const std::size_t shown_rows = std::min<std::size_t>(rows, 10), shown_columns = std::min<std::size_t>(columns, 6);
  fmt::print("\n  efficiency [%] over the load torque [N m] and the worm speed [rad/s]\n\n  {:>12}", "");
  for (std::size_t c = 0; c < shown_columns; ++c)
    fmt::print(" {:>9.4g}", map.speeds[first + spread(columns, shown_columns, c)]);
  fmt::print("\n");
  for (std::size_t r = 0; r < shown_rows; ++r) {
    const std::size_t load = spread(rows, shown_rows, r);
    fmt::print("  {:>12.4g}", map.loads[load]);
    for (std::size_t c = 0; c < shown_columns; ++c) {
      const double share = map.at(first + spread(columns, shown_columns, c), load).efficiency;
      fmt::print(" {:>9}", std::isnan(share) ? "-" : fmt::format("{:.1f}", 100.0 * share));
    }
    fmt::print("\n");
  }
}

void print_best(const Map& map) {
  const auto where = [](const OperatingPoint& p) {
    return fmt::format("{:.1f} % at {:.4g} rad/s of the worm and {:.4g} N m", 100.0 * p.efficiency, p.worm_speed,
                       p.load_torque);
  };
  const OperatingPoint *driven = best(map, false), *driving = best(map, true);
  print_item("motor", driven ? "drives the load with up to " + where(*driven) : "drives none of these loads");
  print_item("load", driving ? "returns up to " + where(*driving)
                             : "returns nothing: the gear locks itself, the motor has to help it along");
}

}  // namespace

int efficiency_command(const EfficiencyOptions& options) {
  reject_overwriting(options.output, options.scenario.file);
  const Scenario scenario = load_scenario(options.scenario.file, options.scenario.overrides, Purpose::look);
  if (std::holds_alternative<SingleInertia<double>>(scenario.mesh))
    reject({options.scenario.file}, "efficiency needs teeth, but mesh.kind is \"none\"");
  Map map{both_ways(options.max_speed, options.points),
          both_ways(options.max_load.value_or(largest_shown_load(scenario)), options.points),
          {}};
  map.points = efficiency_map(scenario, map.speeds, map.loads);
  if (!options.output.empty()) write(options.output, scenario, map, options);
  if (options.scenario.json) {
    print_json(as_json(scenario, map));
    return 0;
  }
  if (options.scenario.quiet) return 0;
  fmt::print("{}\n", scenario.title);
  print_item("regime", describe_mesh(scenario));
  for (const std::string& warning : warnings(scenario))
    if (!warning.starts_with("no [motor.torque]")) print_item("warning", warning);
  print_best(map);
  print_table(map);
  if (!options.output.empty())
    print_item("\n  wrote", fmt::format("{}    see it: wormdrive plot {}", options.output, shell_path(options.output)));
  return 0;
}

}  // namespace wormdrive
