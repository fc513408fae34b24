#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/describe/schema_table.hpp"
#include "cli/describe/study_schema.hpp"
#include "core/data_sheet.hpp"
#include "description/keys.hpp"
#include "description/scenario.hpp"
#include "description/variant_kinds.hpp"

namespace wormdrive {
namespace {

struct SchemaOptions {
  std::string kind = "scenario";  ///< or "study"
};

/// One kind of torque, load, reference or controller.
template <class Kind>
SchemaTable kind_table(Axis axis) {
  SchemaTable table(axis, std::string(Kind::meaning));
  table.with("kind", {{"const", Kind::kind}}).requires_key("kind");
  if constexpr (requires { Kind::fields(); }) table.template fields<Kind>();
  return table.template table<Kind>();
}
template <class Kind>
Json function_of_time(Axis axis) {
  SchemaTable table = kind_table<Kind>(axis);
  if constexpr (requires { Kind::interpolation; }) {
    table.pairs({"times", unit::second}, {"torques", unit::newton_metre});
    table.template choices<Kind>();
  }
  return table.json();
}

/// Any alternative of a variant.
template <class Variant>
std::vector<Json> any_kind(Axis axis) {
  std::vector<Json> list;
  [&]<std::size_t... K>(std::index_sequence<K...>) {
    (list.push_back(function_of_time<std::variant_alternative_t<K, Variant>>(axis)), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>());
  return list;
}
/// One table, or several that add up.
Json one_or_several(const std::vector<Json>& kinds) { return one_of({one_of(kinds), several(one_of(kinds))}); }
Json torque(Axis axis) { return one_or_several(any_kind<SignalTerm>(axis)); }

Json mesh(Axis axis) {
  const Json linear = SchemaTable(axis, "a mass that moves")
                          .with("kind", {{"const", "none"}})
                          .with("axis", {{"const", "linear"}})
                          .requires_key("kind")
                          .requires_key("axis")
                          .fields<SingleInertia<double>>()
                          .json();
  if (axis == Axis::linear) return linear;
  const Json worm =
      SchemaTable(axis, "worm and gear").with("kind", {{"const", "worm"}}).fields<MeshParameters<double>>().json();
  const Json none = SchemaTable(axis, "a single inertia without a gear")
                        .with("kind", {{"const", "none"}})
                        .with("axis", {{"const", "rotary"}})
                        .requires_key("kind")
                        .fields<SingleInertia<double>>()
                        .json();
  return one_of({worm, none, kind_table<DataSheet>(axis).json()});
}

Json load(Axis axis) {
  std::vector<Json> kinds = any_kind<SignalTerm>(axis);
  for_each_load([&]<class Load>() {
    if (axis == Axis::linear && std::is_same_v<Load, GravityArm>) return;
    kinds.push_back(kind_table<Load>(axis).json());
  });
  return one_or_several(kinds);
}

Json effects(Axis axis) {
  SchemaTable all(axis, "what extends the nominal drive");
  Effects<double>{}.for_each([&]<class Effect>(const std::optional<Effect>&) {
    SchemaTable one(axis, fmt::format("{}: {}", name(Effect::place), Effect::cause));
    one.with("on", {{"type", "boolean"}, {"default", true}, {"description", "false switches it off"}});
    all.with(std::string(Effect::id), one.fields<Effect>().template table<Effect>().json());
  });
  return all.json();
}

/// What the columns of recordings are called.
Json recorded_names(Axis axis) {
  SchemaTable table(axis, "column names of the recordings, if they are not the usual ones");
  for (const RecordedColumn& column : recorded_columns) {
    Json name = any_text("its column in the files");
    name["minLength"] = 1;
    table.with(spellings(column.name, column.unit, axis).front().key, name);
  }
  return table.json();
}

Json controller() {
  std::vector<Json> kinds;
  const Axis axis = Axis::rotary;
  const auto add = [&]<class Law>() {
    SchemaTable table = kind_table<Law>(axis);
    table.fields<SamplingSettings>();
    if (winds_up(Law{})) table.fields<AntiWindupSettings>();
    table.with("nominal", SchemaTable(axis, "the controller's model of the drive").fields<NominalSettings>().json());
    table.with("variation",
               SchemaTable(axis, "variations that the controller must withstand").fields<Variations>().json());
    if constexpr (!requires { Law::fields(); }) table.with("torque", torque(axis)).requires_key("torque");
    kinds.push_back(table.json());
  };
  [&]<std::size_t... K>(std::index_sequence<K...>) {
    (add.template operator()<std::variant_alternative_t<K, ControllerParameters>>(), ...);
  }
  (std::make_index_sequence<std::variant_size_v<ControllerParameters>>());
  return one_of(kinds);
}

/// All tables of a scenario on an axis.
Json tables(Axis axis) {
  SchemaTable root(axis);
  root.with("title", any_text("one line"));
  root.with("mesh", mesh(axis)).requires_key("mesh");
  root.with("motor", SchemaTable(axis, "motor torque in open loop").with("torque", torque(axis)).json());
  root.with("load", load(axis)).with("effect", effects(axis));
  root.with("initial", SchemaTable(axis, "where the run starts").fields<InitialState<double>>().json());
  root.with("run", SchemaTable(axis, "duration and accuracy").fields<RunSettings>().json());
  root.with("tolerance", SchemaTable(axis, "standard deviations of stated parameters").fields<Tolerances>().json());
  root.with("limits", SchemaTable(axis, "how far an experiment may drive it").fields<ExperimentLimits>().json());
  root.with("data", recorded_names(axis));
  if (axis == Axis::rotary) {
    root.with("controller", controller());
    root.with("reference", one_or_several(any_kind<ReferenceTerm>(axis)));
    root.with("sensor", SchemaTable(axis, "what the controller measures").fields<SensorSettings>().json());
    root.with("disturbance", SchemaTable(axis, "a random torque on the worm").fields<DisturbanceSettings>().json());
    root.with("metrics", SchemaTable(axis, "time window of the metrics").fields<MetricsWindow>().json());
  }
  return root.json();
}

int schema_command(const SchemaOptions& options) {
  if (options.kind == "study") {
    fmt::print("{}\n", study_schema().dump(1));
    return 0;
  }
  const Json on_linear_axis{
      {"properties",
       {{"mesh", {{"properties", {{"axis", {{"const", "linear"}}}}}, {"required", Json::array({"axis"})}}}}},
      {"required", Json::array({"mesh"})}};
  const Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                    {"title", "wormdrive scenario"},
                    {"description", "A wormdrive scenario in TOML; every key includes its unit"},
                    {"if", on_linear_axis},
                    {"then", tables(Axis::linear)},
                    {"else", tables(Axis::rotary)}};
  fmt::print("{}\n", schema.dump(1));
  return 0;
}

}  // namespace

void add_schema(CommandSet& commands) {
  auto [command, options] =
      commands.add("schema", "print the JSON schema of scenarios or studies, for editors", schema_command);
  command.add_option("--kind", options.kind, "what the schema is of")
      ->check(CLI::IsMember({"scenario", "study"}))
      ->capture_default_str();
}

}  // namespace wormdrive
