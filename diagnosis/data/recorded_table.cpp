#include "diagnosis/data/recorded_table.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "description/keys.hpp"
#include "description/toml/parse_scenario.hpp"
#include "diagnosis/files/stored_columns.hpp"
#include "diagnosis/files/unit_in_words.hpp"
#include "output/hdf5/read_ahead.hpp"
#include "output/hdf5/stored_table.hpp"

namespace wormdrive {
namespace {

std::vector<Spelling> column_spellings(std::string_view name, const Scenario& scenario) {
  const auto* const column = std::find_if(recorded_columns.begin(), recorded_columns.end(),
                                          [&](const RecordedColumn& c) { return c.name == name; });
  return spellings(column->name, column->unit, scenario.axis);
}

/// What stands behind a stem in a column's name, as files write units: "ms", "mNm", "deg/s"; empty where it is not
/// there.
std::string unit_of_name(const std::string& column, const std::string& stem) {
  if (!column.starts_with(stem + "_")) return {};
  std::string words = column.substr(stem.size() + 1);
  const std::string per = "_per_";
  if (const std::size_t at = words.find(per); at != std::string::npos) words.replace(at, per.size(), "/");
  return words;
}

/// Why a column is not there: a name of a file that resembles the one sought, or a way to say what it is called.
std::string missing(const std::string& sought, const Spelling& spelling, const DataTable& table) {
  const std::string& usual = spelling.key;
  std::string text =
      table.csv ? fmt::format("no column '{}'; the header line names {}", sought, fmt::join(table.csv->names, ", "))
                : fmt::format("no column '{}'; the file has {}", sought, table.described());
  std::vector<std::string> similar;
  for (const std::string& name : table.names())
    if (probably_meant(sought, {name}) || probably_meant(name, {sought})) similar.push_back(name);
  const std::string meant = similar.empty() ? "..." : similar.front();
  if (sought != usual) return text;
  if (const std::string words = unit_of_name(meant, spelling.stem); !words.empty())
    return text + fmt::format("; '{}' is no known unit of a quantity in {}", words, spelling.unit.symbol);
  return text + fmt::format("; [data] {} = \"{}\" in the scenario would say which it is", usual, meant);
}

/// What a quantity is called in a table, and the unit of that name; nothing if it is not there.
struct FoundColumn {
  std::string name;
  std::optional<Unit> unit;  ///< nothing where only what the file states beside the column tells it
};
std::optional<FoundColumn> find_recorded(const DataTable& table, std::string_view name, const Scenario& scenario) {
  const std::vector<Spelling> known = column_spellings(name, scenario);
  const std::string sought = recorded_name(name, scenario);
  if (sought != known.front().key) {
    if (!table.has(sought)) return std::nullopt;
    return FoundColumn{sought, table.unit(sought).empty() ? std::optional(known.front().unit) : std::nullopt};
  }
  for (const Spelling& spelling : known)
    if (table.has(spelling.key)) return FoundColumn{spelling.key, spelling.unit};
  const std::string& stem = known.front().stem;
  if (known.front().key != stem)  // a pure number has no unit
    for (const std::string& column : table.names())
      if (const auto size = unit_in_words(unit_of_name(column, stem), known.front().unit.symbol))
        return FoundColumn{column, Unit{{}, {}, *size}};
  if (!table.csv && table.has(stem) && !table.unit(stem).empty()) return FoundColumn{stem, std::nullopt};
  return std::nullopt;
}

/// The size in SI of the unit that a file states beside a column; throws InputFault if it is none of that quantity, or
/// another one than the name says.
double stated_size(const Location& where, const std::string& column, const std::string& words, std::string_view si,
                   const std::optional<Unit>& of_name) {
  const std::optional<double> size = unit_in_words(words, si);
  if (!size) reject(where, fmt::format("{} is in '{}', which is no unit of a quantity in {}", column, words, si));
  if (of_name && std::abs(*size / of_name->si - 1.0) > 1e-12)
    reject(where, fmt::format("{} is in '{}', unlike its name", column, words));
  return *size;
}

RecordedTable from_columns(const DataTable& table, const Scenario& scenario) {
  const auto column = [&](std::string_view name, bool required) {
    return recorded_values(table, name, scenario, required);
  };
  RecordedTable recorded{table.path,
                         table.csv.has_value(),
                         column("time", true),
                         column("motor_torque", true),
                         column("gear_angle", true),
                         column("worm_angle", false),
                         column("gear_speed", false),
                         scenario.axis,
                         {},
                         {}};
  for (const RecordedValues* other : {&recorded.torque, &recorded.angle, &recorded.worm_angle, &recorded.speed})
    if (!other->values.empty())
      require_equal_lengths(table, recorded.time.name, recorded.time.values.size(), other->name, other->values.size());
  return recorded;
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

/// By how many samples the commands of a stored run reached the motor after they were decided. Rejects a controller
/// whose encoder did not sit on the gear.
std::size_t samples_of_delay(const std::string& path, const std::string& scenario) {
  if (scenario.empty()) return 0;  // another program wrote the run
  const auto control = parse_scenario(scenario, path, {}, Purpose::show).control;
  if (!control) return 0;
  if (control->sensor.on_worm)
    reject({path}, "shows the worm's angle only (sensor.shaft = \"worm\"); a diagnosis needs that of the gear");
  return static_cast<std::size_t>(control->sampling.delay);
}

/// The commands that the motor has from each sample on; before the first there is none.
void hold_back(std::vector<double>& decided, std::size_t samples) {
  const std::size_t rows = decided.size();
  decided.insert(decided.begin(), samples, 0.0);
  decided.resize(rows);
}

/// What is recorded of a run, whose columns column(name, unit in SI) reads; delay: of a controller, in samples.
template <class Column>
RecordedTable run_table(const std::string& path, Axis axis, std::optional<std::size_t> delay, bool with_worm,
                        const Column& column) {
  RecordedTable table;
  table.path = path;
  table.has_lines = false;
  table.axis = axis;
  table.time = column("time", "s");
  table.torque = column(delay ? "torque" : "motor_torque", units_on(axis, "N m"));
  table.angle = column(delay ? "measured_angle" : "gear_angle", units_on(axis, "rad"));
  if (delay) {
    hold_back(table.torque.values, *delay);
    return table;
  }
  if (with_worm) table.worm_angle = column("worm_angle", "rad");
  keep_even_rows(table);
  return table;
}

/// A run as HDF5, by whoever wrote it: the columns that are needed, all of them equally long.
RecordedTable from_run(const std::string& path, Axis axis) {
  const Hdf5Handle file = open_hdf5(path);
  std::optional<std::size_t> delay;
  if (has_member(file, "controller"))
    delay = samples_of_delay(path, H5Aexists(file, "scenario") > 0 ? read_text_attribute(file, "scenario") : "");
  const StoredTable run(file, delay ? "controller" : "trajectory");
  run.check({"time", "", ""}, Range::rising);
  return run_table(path, axis, delay, run.has("worm_angle"), [&](const std::string& name, std::string_view si) {
    run.check({name, "", ""}, Range::any);
    RecordedValues column{fmt::format("/{}", run.column(name).path()), 1.0, run.column(name).values()};
    const std::string unit = stated_unit(open_object(file, run.column(name).path()));
    if (!unit.empty()) column.unit = stated_size({path}, column.name, unit, si, std::nullopt);
    for (double& value : column.values) value *= column.unit;
    return column;
  });
}

RecordedTable from_exported_run(const DataTable& table, Axis axis) {
  const auto there = [&](std::string_view name) {
    return std::any_of(table.columns.begin(), table.columns.end(),
                       [&](const StoredNumbers& column) { return column.name == name; });
  };
  std::optional<std::size_t> delay;
  if (there("controller.time")) delay = samples_of_delay(table.path, table.scenario);
  const std::string in = delay ? "controller." : "trajectory.";
  const auto column = [&](const std::string& name, std::string_view si) {
    RecordedValues values{in + name, 1.0, table.numbers(in + name)};
    if (const std::string unit = table.unit(values.name); !unit.empty())
      values.unit = stated_size({table.path}, values.name, unit, si, std::nullopt);
    for (double& value : values.values) value *= values.unit;
    const std::size_t rows = table.numbers(in + "time").size();
    require_equal_lengths(table, in + "time", rows, values.name, values.values.size());
    return values;
  };
  return run_table(table.path, axis, delay, there(in + "worm_angle"), column);
}

}  // namespace

bool is_run_file(const std::string& path) {
  if (!is_hdf5(path)) return false;
  try {
    read_ahead(path);
    return has_member(open_hdf5(path), "trajectory");
  } catch (const OutputFault& fault) {
    reject({path}, fault.what());
  }
}

bool is_exported_run(const DataTable& table) {
  return std::any_of(table.columns.begin(), table.columns.end(),
                     [](const StoredNumbers& column) { return column.name == "trajectory.time"; });
}

std::string recorded_name(std::string_view name, const Scenario& scenario) {
  return column_name(scenario.columns, column_spellings(name, scenario).front().key);
}

bool has_recorded(const DataTable& table, std::string_view name, const Scenario& scenario) {
  return find_recorded(table, name, scenario).has_value();
}

RecordedValues recorded_values(const DataTable& table, std::string_view name, const Scenario& scenario, bool required) {
  const Spelling usual = column_spellings(name, scenario).front();
  const std::optional<FoundColumn> found = find_recorded(table, name, scenario);
  if (!found) {
    const std::string sought = recorded_name(name, scenario);
    if (required || sought != usual.key) reject(table.header(), missing(sought, usual, table));
    return {sought, usual.unit.si, {}};
  }
  RecordedValues column{found->name, found->unit ? found->unit->si : 1.0, table.numbers(found->name)};
  if (const std::string words = table.unit(found->name); !words.empty())
    column.unit = stated_size(table.header(), found->name, words, usual.unit.symbol, found->unit);
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
  if (is_run_file(path)) try {
      return from_run(path, scenario.axis);
    } catch (const OutputFault& fault) {
      reject({path}, fault.what());
    }
  const DataTable table = read_data_table(path);
  return is_exported_run(table) ? from_exported_run(table, scenario.axis) : from_columns(table, scenario);
}

}  // namespace wormdrive
