#include <algorithm>

#include <fmt/format.h>

#include "cli/describe/drive.hpp"
#include "cli/report/kinds.hpp"
#include "description/diagnostics.hpp"
#include "output/trajectory.hpp"

namespace wormdrive {
namespace {

constexpr std::size_t most_events = 2000;  ///< that a page shows; beyond that they are a colour

ReportSeries series(const ResultFile& file, const std::string& table, const std::string& name) {
  const std::string at = table + "/" + name;
  return {name, file.attribute(at, "units"), file.attribute(at, "long_name"), file.column(at)};
}

/// Panels of the columns that the table has, several in one where they belong together.
std::vector<ReportPanel> panels(const ResultFile& file, const std::string& table,
                                const std::vector<std::vector<std::string>>& wanted, ReportPanel::Style style) {
  const std::vector<std::string> there = file.columns(table);
  const std::vector<double> time = file.column(table + "/time");
  std::vector<ReportPanel> list;
  for (const std::vector<std::string>& names : wanted) {
    ReportPanel panel{time, {}, style};
    for (const std::string& name : names)
      if (std::find(there.begin(), there.end(), name) != there.end()) panel.series.push_back(series(file, table, name));
    if (!panel.series.empty()) list.push_back(std::move(panel));
  }
  return list;
}

ReportPanel tracking_error(const ResultFile& file) {
  ReportSeries error = series(file, "controller", "gear_angle");
  const std::vector<double> reference = file.column("controller/reference_angle");
  for (std::size_t k = 0; k < reference.size(); ++k) error.values[k] -= reference[k];
  error.name = "tracking_error";
  error.meaning = "gear angle minus reference";
  return {file.column("controller/time"), {std::move(error)}};
}

struct ModeName {
  std::string kind, meaning;
};
ModeName mode_name(double motion, double flank) {
  if (motion == 0.0) return {"stuck", "stuck"};
  if (flank == 0.0) return {"", ""};
  return flank > 0.0 ? ModeName{"left", "left flank"} : ModeName{"right", "right flank"};
}

std::vector<ReportBand> bands(const ResultFile& file) {
  const std::vector<double> time = file.column("trajectory/time"), motion = file.column("trajectory/motion"),
                            flank = file.column("trajectory/flank");
  std::vector<ReportBand> list;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const ModeName mode = mode_name(motion[k], flank[k]);
    if (!list.empty()) list.back().to = time[k];
    if (list.empty() || list.back().kind != mode.kind) list.push_back({time[k], time[k], mode.kind, mode.meaning});
  }
  std::erase_if(list, [](const ReportBand& band) { return band.kind.empty(); });
  return list;
}

std::string mode_text(double motion, double flank) {
  const std::string moves = motion == 0.0 ? "stuck" : motion > 0.0 ? "forward" : "backward";
  return flank == 0.0 ? moves : fmt::format("{}, {} flank", moves, flank > 0.0 ? "left" : "right");
}

/// The columns of /events row by row: NAME_before and NAME_after are a change.
std::vector<ReportEvent> events(const ResultFile& file) {
  const std::vector<double> time = file.column("events/time"), kind = file.column("events/kind");
  const auto column = [&](const std::string& name) { return file.column("events/" + name); };
  const std::vector<double> motion_before = column("motion_before"), motion_after = column("motion_after"),
                            flank_before = column("flank_before"), flank_after = column("flank_after");
  std::vector<ReportEvent> list;
  for (std::size_t k = 0; k < std::min(time.size(), most_events); ++k)
    list.push_back({time[k],
                    words(std::string(name(event_kinds[static_cast<std::size_t>(kind[k])]))),
                    mode_text(motion_before[k], flank_before[k]),
                    mode_text(motion_after[k], flank_after[k]),
                    {}});
  const std::vector<std::string> names = file.columns("events");
  for (const std::string& name : names) {
    const std::string end = "_before", stem = name.ends_with(end) ? name.substr(0, name.size() - end.size()) : "";
    if (stem.empty() || stem == "motion" || stem == "flank") continue;
    if (std::find(names.begin(), names.end(), stem + "_after") == names.end()) continue;
    const std::vector<double> before = column(name), after = column(stem + "_after");
    const std::string units = file.attribute("events/" + name, "units");
    for (std::size_t k = 0; k < list.size(); ++k) list[k].changes.push_back({words(stem), units, before[k], after[k]});
  }
  return list;
}

/// How well a controller did, as the file has it.
ReportTable control_table(const ResultFile& file) {
  ReportTable table{"Control", {{"metric"}, {"value", true}}, {}};
  for (const auto& [name, value] : file.numbers("controller")) table.rows.push_back({words(name), value});
  return table;
}

}  // namespace

ReportPage report_of_run(const ResultFile& file) {
  const Scenario scenario = file.scenario();
  using enum ReportPanel::Style;
  ReportGroup group{"", "time", "s",
                    panels(file, "trajectory",
                           {{"gear_angle"},
                            {"gear_speed", "worm_speed"},
                            {"gear_acceleration"},
                            {"motor_torque", "load_torque"},
                            {"normal_force", "friction_force"},
                            {"deflection"}},
                           lines)};
  ReportPage page;
  if (file.has("controller")) {
    if (scenario.control && !scenario.control->reference.terms.empty()) group.panels.push_back(tracking_error(file));
    const bool sliding = scenario.control && std::holds_alternative<SlidingParameters>(scenario.control->law);
    std::vector<std::vector<std::string>> wanted{{"torque", "applied_torque"}};
    if (sliding) wanted.push_back({"sliding_variable"});
    for (ReportPanel& panel : panels(file, "controller", wanted, steps)) group.panels.push_back(std::move(panel));
    page.tables.push_back(control_table(file));
  }
  group.bands = bands(file);
  group.events = events(file);
  RunSummary happened;
  for (const double kind : file.column("events/kind")) ++happened.events[static_cast<std::size_t>(kind)];
  group.all_events = static_cast<std::size_t>(happened.total_events());
  const std::vector<double>& time = group.panels.front().over;
  const std::string regime = describe_mesh(scenario);
  page.summary =
      fmt::format("{}{}{:g} s, {} rows, {}{}", regime, regime.empty() ? "" : ". ", time.back() - time.front(),
                  time.size(), describe_events(happened),
                  group.all_events > most_events ? fmt::format(" (the first {} are shown)", most_events) : "");
  page.groups.push_back(std::move(group));
  return page;
}

}  // namespace wormdrive
