#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/describe/drive.hpp"
#include "cli/report/thinning.hpp"
#include "cli/shell_words.hpp"
#include "description/diagnostics.hpp"
#include "description/toml/write_scenario.hpp"
#include "output/hdf5/table.hpp"
#include "output/run_columns.hpp"
#include "simulation/efficiency_map.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/operating_range.hpp"

namespace wormdrive {
namespace {

struct EfficiencyOptions {
  ScenarioOptions scenario;
  std::string output;
  std::optional<double> max_speed;  ///< worm speed [rad/s]
  std::optional<double> max_load;   ///< [N m]
  int points = 20;
  Replace replace = Replace::same_kind;
};

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

const std::vector<RunColumn<OperatingPoint>>& columns() {
  using P = OperatingPoint;
  static const std::vector<RunColumn<P>> list{
      {{"worm_speed", "rad/s", "worm speed"}, [](const P& p) { return p.worm_speed; }},
      {{"load_torque", "N m", "load torque tau_l"}, [](const P& p) { return p.load_torque; }},
      {{"motor_torque", "N m", "motor torque that keeps the speed"}, [](const P& p) { return p.motor_torque; }},
      {{"motor_power", "W", "power into the drive from the motor, or from the supply of its winding"},
       [](const P& p) { return p.motor_power; }},
      {{"load_power", "W", "power into the drive from the load"}, [](const P& p) { return p.load_power; }},
      {{"loss", "W", "power that friction and winding take"}, [](const P& p) { return p.loss; }},
      {{"efficiency", "1", "power out of the drive over power into it"}, [](const P& p) { return p.efficiency; }}};
  return list;
}

void write(const std::string& output, const Scenario& scenario, const Map& map, const EfficiencyOptions& options) {
  PartFile file(output, "efficiency", options.replace);
  write_provenance(file.file(), {"efficiency", scenario.title, to_toml(scenario), options.scenario.command_line});
  GrowingTable(file.file(), "efficiency", descriptions(columns(), scenario.axis)).append(values(columns(), map.points));
  file.finish();
}

/// Speed by speed, null where there is no number.
nlohmann::json as_json(const Scenario& scenario, const Map& map) {
  const auto grid = [&](double OperatingPoint::*value) {
    std::vector<std::vector<double>> rows(map.speeds.size());
    for (std::size_t s = 0; s < rows.size(); ++s)
      for (std::size_t l = 0; l < map.loads.size(); ++l) rows[s].push_back(map.at(s, l).*value);
    return rows;
  };
  return {{"title", scenario.title},
          {"worm_speed_rad_per_s", map.speeds},
          {"load_torque_Nm", map.loads},
          {"motor_torque_Nm", grid(&OperatingPoint::motor_torque)},
          {"efficiency", grid(&OperatingPoint::efficiency)}};
}

/// Five loads of each sign over up to six speeds forward: what fits on a screen; the file has them all.
void print_table(const Map& map) {
  const std::size_t forward = map.speeds.size() / 2;
  const std::vector<std::size_t> speeds = even_rows(forward, 6);
  fmt::print("\n  efficiency [%] over the load torque [N m] and the worm speed [rad/s]\n\n  {:>12}", "");
  for (const std::size_t s : speeds) fmt::print(" {:>9.4g}", map.speeds[forward + s]);
  fmt::print("\n");
  for (const std::size_t load : even_rows(map.loads.size(), 10)) {
    fmt::print("  {:>12.4g}", map.loads[load]);
    for (const std::size_t s : speeds) {
      const double share = map.at(forward + s, load).efficiency;
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
                             : "returns nothing at any of these loads: the motor has to help it along");
}

int efficiency_command(const EfficiencyOptions& options) {
  reject_overwriting(options.output, options.scenario.file);
  const Scenario scenario = load_scenario(options.scenario.file, options.scenario.overrides, Purpose::look);
  if (std::holds_alternative<SingleInertia<double>>(scenario.mesh))
    reject({options.scenario.file}, "efficiency needs teeth, but mesh.kind is \"none\"");
  const OperatingRange shown = options.max_speed && options.max_load ? OperatingRange{} : operating_range(scenario);
  Map map{both_ways(options.max_speed.value_or(shown.worm_speed), options.points),
          both_ways(options.max_load.value_or(shown.load_torque), options.points),
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
  for (const std::string& warning : warnings(scenario, MotorTorque::sought)) print_item("warning", warning);
  print_best(map);
  print_table(map);
  if (!options.output.empty())
    print_item("\n  wrote", fmt::format("{}    see it: wormdrive plot {}", options.output, shell_path(options.output)));
  return 0;
}

}  // namespace

void add_efficiency(CommandSet& commands) {
  auto [command, options] =
      commands.add("efficiency", "compute the efficiency over worm speed and load torque", efficiency_command);
  add_scenario_options(command, options.scenario);
  add_optional_output(command, options.output);
  command
      .add_option("--max-speed", options.max_speed, "largest worm speed [rad/s]; default: that of the scenario's run")
      ->check(finite_number(false));
  add_max_load(command, options.max_load);
  command.add_option("--points", options.points, "number of speeds in each direction, and of loads of each sign")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  add_force(command, options.replace);
}

}  // namespace wormdrive
