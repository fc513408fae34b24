#include "core/statics.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/describe/drive.hpp"
#include "cli/shell_words.hpp"
#include "description/build.hpp"
#include "description/diagnostics.hpp"
#include "description/toml/write_scenario.hpp"
#include "output/hdf5/table.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/operating_range.hpp"
#include "simulation/steady_scenario.hpp"

namespace wormdrive {
namespace {

struct StaticsOptions {
  ScenarioOptions scenario;
  std::string output;
  std::optional<double> max_load;  ///< [N m]
  int points = 41;
  Replace replace = Replace::same_kind;
};

/// The break-in map: stick region and static surface over the load torque [N m].
struct StaticsMap {
  std::vector<double> load, low, high, surface;
};

/// The mesh as it starts forward, and as it starts backward: friction may differ.
StaticsMap make_map(const GearMesh<double>& forward, const GearMesh<double>& backward, double max_load, int points) {
  StaticsMap map;
  for (int k = 0; k < points; ++k) {
    const double tau_l = max_load * (2.0 * k - (points - 1)) / (points - 1);
    map.load.push_back(tau_l);
    map.low.push_back(stick_region(backward, tau_l).low);
    map.high.push_back(stick_region(forward, tau_l).high);
    map.surface.push_back(forward.H() * tau_l);
  }
  return map;
}

void write(const std::string& output, const Scenario& scenario, const StaticsMap& map, const StaticsOptions& options) {
  const GearMesh<double> mesh = make_mesh(scenario);
  PartFile file(output, "statics", options.replace);
  write_provenance(file.file(), {"statics", scenario.title, to_toml(scenario), options.scenario.command_line});
  write_attribute(file.file(), "regime", name(mesh.regime()));
  for (const auto& [key, value] : {std::pair{"C1", mesh.C1()},
                                   {"C2", mesh.C2()},
                                   {"H", mesh.H()},
                                   {"mu", mesh.mu},
                                   {"mu_w", mesh.mu_w()},
                                   {"mu_g", mesh.mu_g()}})
    write_attribute(file.file(), key, value);
  write_attribute(file.file(), "stuck_outside",
                  std::int64_t{mesh.regime() == LockingRegime::worm_self_locking ? 1 : 0});
  GrowingTable(file.file(), "statics",
               {{"load_torque", "N m", "load torque tau_l"},
                {"stick_low", "N m", "lower limit of the motor torques that hold the gear, or of the moving wedge"},
                {"stick_high", "N m", "upper limit of the motor torques that hold the gear, or of the moving wedge"},
                {"static_surface", "N m", "motor torque H tau_l at which the tooth changes its flank at rest"}})
      .append({map.load, map.low, map.high, map.surface});
  file.finish();
}

/// The table is of the teeth alone; this is the drive as it stands.
void print_start(const Scenario& scenario) {
  const RestAtStart rest = rest_at_start(scenario);
  fmt::print("\n");
  print_item("start", fmt::format("with all effects, at the initial angle (load {:.6g} N m): at rest from {:.6g} to "
                                  "{:.6g} N m",
                                  rest.load, rest.low, rest.high));
}

void print_table(const StaticsMap& map, bool outside) {
  fmt::print("\n  {:>14} {:>18} {:>18} {:>16}\n", "load [N m]", outside ? "moves from [N m]" : "backward [N m]",
             outside ? "to [N m]" : "forward [N m]", "H tau_l [N m]");
  constexpr std::size_t rows = 11;  // what fits on a screen; the file has them all
  const std::size_t stride = std::max<std::size_t>(1, (map.load.size() - 1) / (rows - 1));
  for (std::size_t k = 0; k < map.load.size(); k += stride)
    fmt::print("  {:>14.6g} {:>18.6g} {:>18.6g} {:>16.6g}\n", map.load[k], map.low[k], map.high[k], map.surface[k]);
}

int statics_command(const StaticsOptions& options) {
  reject_overwriting(options.output, options.scenario.file);
  const Scenario scenario = load_scenario(options.scenario.file, options.scenario.overrides, Purpose::look);
  const GearMesh<double> mesh = make_mesh(scenario);
  if (!mesh.has_teeth) reject({options.scenario.file}, "statics needs teeth, but mesh.kind is \"none\"");
  const StaticsMap map =
      make_map(make_mesh(scenario, Motion::forward), make_mesh(scenario, Motion::backward),
               options.max_load ? *options.max_load : operating_range(scenario).load_torque, options.points);
  const bool outside = mesh.regime() == LockingRegime::worm_self_locking;
  if (!options.output.empty()) write(options.output, scenario, map, options);
  if (options.scenario.json) {
    print_json({{"title", scenario.title},
                {"regime", name(mesh.regime())},
                {"C1", mesh.C1()},
                {"C2", mesh.C2()},
                {"H", mesh.H()},
                {"stuck_outside", outside},
                {"load_torque_Nm", map.load},
                {"stick_low_Nm", map.low},
                {"stick_high_Nm", map.high}});
    return 0;
  }
  if (options.scenario.quiet) return 0;
  fmt::print("{}\n", scenario.title);
  print_item("regime", describe_mesh(scenario));
  print_item("break-in", outside
                             ? "without load no torque moves the gear; under load it moves between the two limits below"
                             : "motor torque at which the gear starts to turn, over the load torque:");
  for (const std::string& warning : warnings(scenario)) print_item("warning", warning);
  print_table(map, outside);
  if (!outside) print_start(scenario);
  if (!options.output.empty())
    print_item("\n  wrote", fmt::format("{}    see it: wormdrive plot {}", options.output, shell_path(options.output)));
  return 0;
}

}  // namespace

void add_statics(CommandSet& commands) {
  auto [command, options] = commands.add("statics", "compute the locking regime and break-in torques", statics_command);
  add_scenario_options(command, options.scenario);
  add_optional_output(command, options.output);
  add_max_load(command, options.max_load);
  command.add_option("--points", options.points, "number of load torques from -max to +max")
      ->check(CLI::Range(3, 100000))
      ->capture_default_str();
  add_force(command, options.replace);
}

}  // namespace wormdrive
