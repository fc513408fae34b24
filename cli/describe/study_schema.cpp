#include "cli/describe/study_schema.hpp"

#include "cli/describe/schema_table.hpp"
#include "description/variant_kinds.hpp"
#include "sweep/study/study.hpp"

namespace wormdrive {
namespace {

Json number_from(double least, const std::string& description) {
  return {{"type", "number"}, {"minimum", least}, {"description", description}};
}
Json list_of_numbers(const std::string& description) {
  return {{"type", "array"}, {"minItems", 1}, {"items", {{"type", "number"}}}, {"description", description}};
}
Json list_of_texts(const std::string& description) {
  return {{"type", "array"}, {"items", {{"type", "string"}}}, {"description", description}};
}
SchemaTable parameter_table() {
  SchemaTable table(Axis::rotary);
  table.with("path", any_text("the number that is uncertain, as --set takes it")).requires_key("path");
  return table;
}
const char* const file_of_study = "CSV file, relative to the folder of the study";

/// The keys of a distribution that are no single numbers.
template <class Parametric>
void add_lists(SchemaTable& table, const Parametric*) {
  table.fields<Parametric>();
}
void add_lists(SchemaTable& table, const Discrete*) {
  table.with("values", list_of_numbers("in the unit of the path")).requires_key("values");
  table.with("weights", list_of_numbers("equally likely if not stated"));
}
void add_lists(SchemaTable& table, const QuantileTable*) {
  table.with("values", list_of_numbers("in the unit of the path")).requires_key("values");
  table.with("probabilities", list_of_numbers("from 0 to 1")).requires_key("probabilities");
}
void add_lists(SchemaTable& table, const Empirical*) {
  table.with("file", any_text(file_of_study)).requires_key("file");
  table.with("column", any_text("its column with the values")).requires_key("column");
}
void add_lists(SchemaTable& table, const RowOfFile*) {
  table.with("file", any_text(file_of_study)).requires_key("file");
  table.with("column", any_text("its column with the values, the path if not stated"));
}

/// The keys of a design.
template <class Sampled>
void add_keys(SchemaTable& table, const Sampled*) {
  table.with("trials", number_from(1, "number of trials")).requires_key("trials");
}
void add_keys(SchemaTable& table, const Saltelli*) {
  table.with("samples", number_from(2, "there are samples (parameters + 2) trials")).requires_key("samples");
  table.with("second_order", {{"type", "boolean"},
                              {"default", false},
                              {"description", "indices of pairs, too, by samples (2 parameters + 2) trials"}});
}
void add_keys(SchemaTable& table, const Shapley*) {
  table.with("permutations", number_from(2, "there are permutations (parameters + 1) trials"));
  table.requires_key("permutations");
}
void add_keys(SchemaTable& table, const Morris*) {
  table.with("trajectories", number_from(2, "there are trajectories (parameters + 1) trials"));
  table.requires_key("trajectories").with("levels", number_from(2, "an even number, 4 if not stated"));
}
void add_keys(SchemaTable& table, const Grid*) { table.with("levels", number_from(1, "levels of each parameter")); }
void add_keys(SchemaTable& table, const OneAtATime*) { add_keys(table, static_cast<const Grid*>(nullptr)); }
void add_keys(SchemaTable& table, const TableOfPoints*) {
  table.with("file", any_text(file_of_study)).requires_key("file");
}

/// Calls visit(a null pointer to it) for every alternative of a variant.
template <class Variant, class Visit>
void for_each_alternative(Visit&& visit) {
  [&]<std::size_t... K>(std::index_sequence<K...>) {
    (visit(static_cast<const std::variant_alternative_t<K, Variant>*>(nullptr)), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>());
}

Json parameter() {
  std::vector<Json> kinds;
  for_each_alternative<Distribution>([&]<class Kind>(const Kind* kind) {
    SchemaTable table = parameter_table();
    table.with("distribution", {{"const", Kind::kind}}).requires_key("distribution");
    table.with("levels", number_from(1, "of a grid"));
    add_lists(table, kind);
    kinds.push_back(table.json());
  });
  kinds.push_back(parameter_table().with("column", any_text("of the table of points, if it is not the path")).json());
  return one_of(kinds);
}

Json sweep() {
  std::vector<Json> kinds;
  for_each_alternative<DesignSettings>([&]<class Kind>(const Kind* kind) {
    SchemaTable table(Axis::rotary);
    table.with("design", {{"const", Kind::kind}}).requires_key("design");
    add_keys(table, kind);
    table.with("seed", number_from(0, "seed of all draws"));
    table.with("common_random_numbers",
               {{"type", "boolean"}, {"default", false}, {"description", "all trials have the noise of the scenario"}});
    table.with(
        "keep",
        {{"type", "array"}, {"items", {{"type", "number"}}}, {"description", "trials whose trajectories are kept"}});
    table.with("keep_worst", number_from(0, "worst trials whose trajectories are kept"));
    table.with("keep_worst_by", any_text("metric that ranks them"));
    for (const Spelling& s : spellings("referee_tolerance", unit::radian, Axis::rotary))
      table.with(s.key, {{"type", "number"}, {"exclusiveMinimum", 0.0}, {"description", "of the gear angle"}});
    kinds.push_back(table.json());
  });
  return one_of(kinds);
}

}  // namespace

nlohmann::ordered_json study_schema() {
  SchemaTable root(Axis::rotary);
  root.with("title", any_text("one line"));
  root.with("scenario", any_text("file of the scenario, relative to the folder of the study")).requires_key("scenario");
  root.with("set", list_of_texts("KEY=VALUE, as --set, for every trial"));
  root.with("metrics", list_of_texts("those that are kept; all if not stated"));
  root.with("sweep", sweep()).requires_key("sweep");
  root.with("parameter", several(parameter())).requires_key("parameter");
  root.with(
      "correlation",
      several(SchemaTable(Axis::rotary, "of normal scores")
                  .with("between", list_of_texts("paths of two parameters"))
                  .requires_key("between")
                  .with("coefficient", {{"type", "number"}, {"exclusiveMinimum", -1.0}, {"exclusiveMaximum", 1.0}})
                  .requires_key("coefficient")
                  .json()));
  // further keys hang on the kind, their unit on the column
  root.with("metric", several({{"type", "object"},
                               {"properties",
                                {{"name", any_text("small letters, digits and _")},
                                 {"table", {{"enum", {"trajectory", "controller"}}, {"default", "trajectory"}}},
                                 {"column", any_text("of the result of a run")},
                                 {"kind", {{"enum", kinds_of<MetricKind>()}}},
                                 {"from_s", number_from(0, "start of the part of the run that counts")},
                                 {"to_s", number_from(0, "its end")},
                                 {"at_s", number_from(0, "of a value")},
                                 {"time_percent", number_from(0, "of a quantile: share of the time")},
                                 {"direction", {{"enum", {"either", "rising", "falling"}}}},
                                 {"number", number_from(1, "of a crossing")}}},
                               {"required", Json::array({"name", "column", "kind"})},
                               {"description",
                                "a number that a column of a run comes to; level_UNIT, band_UNIT and target_UNIT have "
                                "the unit of the column"}}));
  // the unit of above and below is that of the metric
  root.with("threshold", several({{"type", "object"},
                                  {"properties",
                                   {{"metric", any_text("metric with a limit")},
                                    {"until_percent", number_from(0.01, "the sweep ends at an interval so narrow")}}},
                                  {"required", Json::array({"metric"})},
                                  {"description", "either above_UNIT or below_UNIT"}}));
  root.with("data", {{"type", "object"}, {"description", "columns of the CSV files, where the study carries them"}});
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "wormdrive study"},
              {"description", "A wormdrive study in TOML: what is uncertain in a scenario"}};
  schema.update(root.json());
  return schema;
}

}  // namespace wormdrive
