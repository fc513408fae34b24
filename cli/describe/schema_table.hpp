#pragma once
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/field.hpp"
#include "core/table_columns.hpp"
#include "description/keys.hpp"

namespace wormdrive {

using Json = nlohmann::ordered_json;

inline Json any_text(const std::string& description) { return {{"type", "string"}, {"description", description}}; }
inline Json words(const std::vector<std::string>& list, const std::string& description) {
  return {{"enum", list}, {"description", description}};
}
/// A choice whose first word holds where nothing is stated.
inline Json choice(const std::vector<std::string>& list, const std::string& description) {
  Json one = words(list, description);
  one["default"] = list.front();
  return one;
}
inline Json numbers(const Spelling& s) {
  return {{"type", "array"}, {"items", {{"type", "number"}}}, {"description", fmt::format("[{}]", s.unit.symbol)}};
}

/// The schema of one table on an axis.
class SchemaTable {
 public:
  explicit SchemaTable(Axis axis, const std::string& description = "")
      : axis_(axis), json_{{"type", "object"}, {"additionalProperties", false}} {
    if (!description.empty()) json_["description"] = description;
    json_["properties"] = Json::object();
  }

  SchemaTable& with(const std::string& key, Json value) {
    json_["properties"][key] = std::move(value);
    return *this;
  }
  SchemaTable& requires_key(const std::string& key) {
    json_["required"].push_back(key);
    return *this;
  }
  /// Every field of a parameter struct, in each of its spellings, with its bounds in that unit.
  template <class Parameters>
  SchemaTable& fields() {
    choices<Parameters>();
    const Parameters defaults{};
    for_each_field<Parameters>([&](const auto& field) {
      const std::optional<double> value = defaults.*field.member;
      const std::vector<Spelling> all = spellings(field.name, field.unit, axis_);
      for (const Spelling& s : all) with(s.key, number(field, s, value));
      if (field.presence == Presence::required) required(all);
    });
    return *this;
  }
  template <class Parameters>
  SchemaTable& choices() {
    for_each_choice<Parameters>([&](const auto& one) {
      with(std::string(one.key), choice({one.words.begin(), one.words.end()}, std::string(one.meaning)));
    });
    return *this;
  }
  /// A function that a file or two arrays state.
  SchemaTable& pairs(const ColumnName& points, const ColumnName& values) {
    with("file", any_text("CSV file, relative to the folder of the scenario"));
    with("x_column", any_text(fmt::format("its column of {}", points.stem)));
    with("y_column", any_text(fmt::format("its column of {}", values.stem)));
    for (const ColumnName& name : {points, values})
      for (const Spelling& s : spellings(name.stem, name.unit, axis_)) with(s.key, numbers(s));
    return *this;
  }
  /// The table among the parameters of a struct, if it has one.
  template <class Parameters>
  SchemaTable& table() {
    for (const TableColumns& columns : possible_columns<Parameters>()) pairs(columns.points, columns.values);
    return *this;
  }
  Json json() const { return json_; }

 private:
  template <class Field>
  Json number(const Field& field, const Spelling& s, const std::optional<double>& value) const {
    std::string description = in_words_of(axis_, field.meaning);
    if (!s.unit.suffix.empty()) description += fmt::format(" [{}]", s.unit.symbol);
    Json one{{"type", "number"}, {"description", description}};
    if (s.unit.whole) one["multipleOf"] = 1;  // 2.0 is as good as 2
    const auto bound = [&](double si, bool exclusive, const std::string& inclusive_key, const std::string& key) {
      if (std::isfinite(si)) one[exclusive ? key : inclusive_key] = si / s.unit.si;
    };
    bound(field.bounds.low, field.bounds.low_exclusive, "minimum", "exclusiveMinimum");
    bound(field.bounds.high, field.bounds.high_exclusive, "maximum", "exclusiveMaximum");
    if (field.presence == Presence::optional && value && std::isfinite(*value)) one["default"] = *value / s.unit.si;
    return one;
  }
  void required(const std::vector<Spelling>& all) {
    if (all.size() == 1) {
      requires_key(all.front().key);
      return;
    }
    Json any = Json::array();
    for (const Spelling& s : all) any.push_back({{"required", Json::array({s.key})}});
    json_["allOf"].push_back({{"anyOf", any}});
  }

  Axis axis_;
  Json json_;
};

inline Json one_of(const std::vector<Json>& kinds) {
  Json one = Json::object();
  one["oneOf"] = kinds;
  return one;
}
inline Json several(const Json& one) { return {{"type", "array"}, {"minItems", 1}, {"items", one}}; }

}  // namespace wormdrive
