#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "core/table_columns.hpp"
#include "description/keys.hpp"
#include "description/toml/table_reader.hpp"
#include "output/resource.hpp"
#include "simulation/load_scenario.hpp"

namespace wormdrive {
namespace {

struct ListOptions {
  std::string topic;
};

/// How a field is written, and its default in that unit if it has one to show.
template <class Parameters, class Field>
std::pair<Spelling, std::optional<double>> stated(const Field& field) {
  const Parameters defaults{};
  const Spelling s = spellings(field.name, field.unit, Axis::rotary).front();
  const std::optional<double> value = defaults.*field.member;
  if (field.presence == Presence::required || !value || !std::isfinite(*value)) return {s, std::nullopt};
  return {s, *value / s.unit.si};
}

/// "must be at least 1 and at most 4, a whole number"; empty where everything is allowed.
std::string limits(const Bounds& bounds, const Unit& unit) {
  std::string text = std::isfinite(bounds.low) || std::isfinite(bounds.high) ? rule(bounds, unit) : "";
  if (unit.whole) text += text.empty() ? "a whole number" : ", a whole number";
  return text;
}

/// The words among which a key chooses, first that which holds where none is stated.
template <class Parameters>
void print_choices() {
  for_each_choice<Parameters>([](const auto& one) {
    fmt::print("      {:<28} {}: \"{}\"\n", one.key, one.meaning, fmt::join(one.words, "\", \""));
  });
}

/// How the table of a parameter struct is stated, each way that its choices allow.
template <class Parameters>
std::vector<std::string> ways_to_state_table() {
  std::vector<std::string> ways;
  const auto key = [](const ColumnName& name) { return spellings(name.stem, name.unit, Axis::rotary).front().key; };
  for (const TableColumns& columns : possible_columns<Parameters>()) {
    const std::string way = fmt::format("{} and {}", key(columns.points), key(columns.values));
    if (std::find(ways.begin(), ways.end(), way) == ways.end()) ways.push_back(way);
  }
  return ways;
}

template <class Parameters>
void print_fields() {
  print_choices<Parameters>();
  for_each_field<Parameters>([](const auto& field) {
    const auto [s, value] = stated<Parameters>(field);
    std::string note = field.presence == Presence::required ? ", required" : "";
    if (value) note = fmt::format(", default {:g}", *value);
    const std::string limit = limits(field.bounds, s.unit);
    fmt::print("      {:<28} {}{}{}{}\n", s.key, field.meaning, note, limit.empty() ? "" : "; ", limit);
  });
}

void print_kind(std::string_view kind, std::string_view meaning) { fmt::print("  {:<18} {}\n", kind, meaning); }

/// Prints how a table is stated, if there is one.
template <class Parameters>
void print_table() {
  if (const auto ways = ways_to_state_table<Parameters>(); !ways.empty())
    fmt::print("      file (with x_column, y_column), or {}\n", fmt::join(ways, ", or "));
}

/// Prints a kind with its fields and its table; one without either is described by `otherwise`.
template <class Kind>
void print_kind(std::string_view otherwise = "") {
  print_kind(Kind::kind, Kind::meaning);
  print_table<Kind>();
  if constexpr (requires { Kind::fields(); }) {
    print_fields<Kind>();
  } else if constexpr (!requires { Kind::columns(); }) {
    fmt::print("      {}\n", otherwise);
    print_choices<Kind>();
  }
}

/// Prints every alternative of a variant.
template <class Variant>
void print_kinds(std::string_view otherwise = "") {
  [&]<std::size_t... K>(std::index_sequence<K...>) {
    (print_kind<std::variant_alternative_t<K, Variant>>(otherwise), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>());
}

/// Calls visit.template operator()<Effect>() for every effect of the catalogue.
template <class Visit>
void for_each_effect(Visit&& visit) {
  Effects<double>{}.for_each([&]<class Effect>(const std::optional<Effect>&) { visit.template operator()<Effect>(); });
}

void list_effects() {
  fmt::print("effects: [effect.ID] in a scenario; on = false switches one off\n");
  for_each_effect([]<class Effect>() {
    print_kind(Effect::id, fmt::format("{}: {}", name(Effect::place), Effect::cause));
    fmt::print("      {}\n", Effect::law);
    print_table<Effect>();
    print_fields<Effect>();
  });
}

/// The catalogue as docs/effects.md has it, without the worked values.
void list_effects_as_markdown() {
  for_each_effect([]<class Effect>() {
    fmt::print("## `{}`\n\nActs on the **{}**: {}.\n\n    {}\n\n", Effect::id, name(Effect::place), Effect::cause,
               Effect::law);
    if constexpr (requires { Effect::source; }) fmt::print("Source: {}.\n\n", Effect::source);
    fmt::print("| key | unit | default | limits | meaning |\n|---|---|---|---|---|\n");
    for_each_choice<Effect>([](const auto& one) {
      fmt::print("| `{}` |  | {} | \"{}\" | {} |\n", one.key, one.words.front(), fmt::join(one.words, "\", \""),
                 one.meaning);
    });
    if (const auto ways = ways_to_state_table<Effect>(); !ways.empty())
      fmt::print(
          "| table |  | required | at least four points | `file` (CSV, with `x_column`, `y_column`), or arrays {} |\n",
          fmt::join(ways, ", or "));
    for_each_field<Effect>([](const auto& field) {
      const auto [s, value] = stated<Effect>(field);
      const std::string absent = field.presence == Presence::required ? "required" : "none";
      fmt::print("| `{}` | {} | {} | {} | {} |\n", s.key, s.unit.symbol, value ? fmt::format("{:g}", *value) : absent,
                 limits(field.bounds, s.unit), field.meaning);
    });
    fmt::print("\n");
  });
}

void list_torques() {
  fmt::print("torques: [motor.torque] kind = \"...\", or several as [[motor.torque]], which add up\n");
  print_kinds<SignalTerm>("file (with x_column, y_column), or times_s and torques_Nm");
}

void list_loads() {
  fmt::print(
      "loads: [load] kind = \"...\", or several as [[load]], which add up; any torque over time (wormdrive list "
      "torques), or\n");
  for_each_load([]<class Load>() { print_kind<Load>(); });
}

void list_controllers() {
  fmt::print("controllers: [controller] kind = \"...\", with any kind\n");
  print_fields<SamplingSettings>();
  print_kinds<ControllerParameters>("torque: [[controller.torque]], any torque over time (wormdrive list torques)");
  fmt::print("of sliding and pid:\n");
  print_fields<AntiWindupSettings>();
  fmt::print("its model of the drive: [controller.nominal]\n");
  print_fields<NominalSettings>();
  fmt::print("variations that it must withstand: [controller.variation]\n");
  print_fields<Variations>();
  fmt::print("what it measures: [sensor]\n");
  print_fields<SensorSettings>();
  fmt::print("a random torque on the worm: [disturbance]\n");
  print_fields<DisturbanceSettings>();
  fmt::print("when its metrics are taken: [metrics]\n");
  print_fields<MetricsWindow>();
}

void list_references() {
  fmt::print("references: [reference] kind = \"...\", or several as [[reference]], which add up\n");
  print_kinds<ReferenceTerm>();
}

void list_scenarios() {
  const std::string folder = resource("share/wormdrive/scenarios");
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  fmt::print("scenarios in {}\n", folder);
  for (const auto& file : files)
    fmt::print("  {:<36} {}\n", file.filename().string(), load_scenario(file.string(), {}, Purpose::look).title);
}

int list_command(const ListOptions& options) {
  const std::string& what = options.topic;
  if (what == "effects") list_effects();
  if (what == "effects.md") list_effects_as_markdown();
  if (what == "torques") list_torques();
  if (what == "loads") list_loads();
  if (what == "controllers") list_controllers();
  if (what == "references") list_references();
  if (what == "scenarios") list_scenarios();
  return 0;
}

}  // namespace

void add_list(CommandSet& commands) {
  auto [command, options] =
      commands.add("list", "list effects, loads, torques, controllers, references or scenarios", list_command);
  command.add_option("topic", options.topic, "what to list; effects.md prints the effects as a Markdown page")
      ->required()
      ->check(CLI::IsMember({"effects", "effects.md", "loads", "torques", "controllers", "references", "scenarios"}));
}

}  // namespace wormdrive
