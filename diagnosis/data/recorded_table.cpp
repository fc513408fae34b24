#include "diagnosis/data/recorded_table.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "description/keys.hpp"
#include "output/hdf5/read_ahead.hpp"
#include "output/hdf5/stored_table.hpp"

namespace wormdrive {
namespace {

std::vector<Spelling> column_spellings(std::string_view name, const Scenario& scenario) {
  const auto* const column = std::find_if(recorded_columns.begin(), recorded_columns.end(),
                                          [&](const RecordedColumn& c) { return c.name == name; });
  return spellings(column->name, column->unit, scenario.axis);
}

/// Why a column is not there: a name of a file that resembles the one sought, or a way to say what it is called.
std::string missing(const std::string& sought, const std::string& usual, const Csv& csv) {
  std::string text = fmt::format("no column '{}'; the header line names {}", sought, fmt::join(csv.names, ", "));
  std::vector<std::string> similar;
  for (const std::string& name : csv.names)
    if (probably_meant(sought, {name}) || probably_meant(name, {sought})) similar.push_back(name);
  const std::string meant = similar.empty() ? "..." : similar.front();
  if (sought != usual) return text;
  return text + fmt::format("; [data] {} = \"{}\" in the scenario would say which it is", usual, meant);
}

RecordedTable from_csv(const std::string& path, const Scenario& scenario) {
  const Csv csv = read_csv(path);
  const auto column = [&](std::string_view name, bool required) {
    return recorded_values(csv, name, scenario, required);
  };
  return {path,
          true,
          column("time", true),
          column("motor_torque", true),
          column("gear_angle", true),
          column("worm_angle", false),
          column("gear_speed", false),
          scenario.axis,
          {},
          {}};
}

/// The rows of a run without a controller that lie on the even grid of its report interval; of the two rows of an event
/// on the grid the one after it, from where its torque holds on.
void keep_even_rows(RecordedTable& table) {
  std::vector<double>& time = table.time.values;
  std::vector<double> steps;
  for (std::size_t k = 1; k < time.size(); ++k) steps.push_back(time[k] - time[k - 1]);
  if (steps.empty()) return;
  const double interval = *std::max_element(steps.begin(), steps.end());
  std::vector<std::size_t> even;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const double rows = (time[k] - time.front()) / interval;
    if (std::abs(rows - std::round(rows)) > 1e-6) continue;
    if (even.empty() || time[k] - time[even.back()] > 0.5 * interval)
      even.push_back(k);
    else
      even.back() = k;
  }
  for (RecordedValues* column : {&table.time, &table.torque, &table.angle, &table.worm_angle}) {
    if (column->values.empty()) continue;
    std::vector<double> kept;
    for (const std::size_t k : even) kept.push_back(column->values[k]);
    column->values = std::move(kept);
  }
}

/// What is recorded of a run, by whoever wrote it: the columns that are needed, all of them equally long.
RecordedTable from_run(const std::string& path, Axis axis) {
  read_ahead(path);
  const Hdf5Handle file = open_hdf5(path);
  if (!has_member(file, "trajectory"))
    reject({path}, "there is no run in this file: a recording has a group /trajectory");
  const bool controlled = has_member(file, "controller");
  const StoredTable run(file, controlled ? "controller" : "trajectory");
  run.check({"time", "", ""}, Range::rising);
  const auto column = [&](const char* name) {
    run.check({name, "", ""}, Range::any);
    return RecordedValues{fmt::format("/{}", run.column(name).path()), 1.0, run.column(name).values()};
  };
  RecordedTable table;
  table.path = path;
  table.has_lines = false;
  table.axis = axis;
  table.time = column("time");
  table.torque = column(controlled ? "torque" : "motor_torque");
  table.angle = column(controlled ? "measured_angle" : "gear_angle");
  if (controlled) return table;
  if (run.has("worm_angle")) table.worm_angle = column("worm_angle");
  keep_even_rows(table);
  return table;
}

}  // namespace

std::string recorded_name(std::string_view name, const Scenario& scenario) {
  return column_name(scenario.columns, column_spellings(name, scenario).front().key);
}

RecordedValues recorded_values(const Csv& csv, std::string_view name, const Scenario& scenario, bool required) {
  const std::vector<Spelling> known = column_spellings(name, scenario);
  const std::string usual = known.front().key;
  const std::string sought = recorded_name(name, scenario);
  const auto has = [&](const std::string& column) {
    return std::find(csv.names.begin(), csv.names.end(), column) != csv.names.end();
  };
  RecordedValues column{sought, known.front().unit.si, {}};
  if (sought == usual)
    for (const Spelling& spelling : known)
      if (!has(column.name) && has(spelling.key)) column = {spelling.key, spelling.unit.si, {}};
  if (!has(column.name)) {
    if (required || sought != usual) reject({csv.path, 1}, missing(sought, usual, csv));
    return column;
  }
  column.values = csv.numbers(column.name);
  for (double& value : column.values) value *= column.unit;
  return column;
}

bool RecordedTable::crosses_pause(std::size_t sample, std::size_t half_width) const {
  const auto next = std::upper_bound(restarts.begin(), restarts.end(), sample - std::min(sample, half_width));
  return next != restarts.end() && *next <= sample + half_width;
}

Location RecordedTable::where(std::size_t sample) const {
  if (!has_lines) return {path};
  return {path, lines.empty() ? static_cast<std::uint32_t>(sample + 2) : lines[sample]};
}

RecordedTable read_recorded_table(const std::string& path, const Scenario& scenario) {
  if (!is_hdf5(path)) return from_csv(path, scenario);
  try {
    return from_run(path, scenario.axis);
  } catch (const OutputFault& fault) {
    reject({path}, fault.what());
  }
}

}  // namespace wormdrive
