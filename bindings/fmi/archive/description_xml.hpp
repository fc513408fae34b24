#pragma once
#include <locale>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>

#include "bindings/fmi/archive/variable_list.hpp"
#include "bindings/fmi/fmu_model.hpp"
#include "output/program.hpp"

namespace wormdrive {

// What the descriptions of both versions have in common.

using Tree = boost::property_tree::ptree;

inline void attribute(Tree& at, const std::string& name, const std::string& value) {
  at.put("<xmlattr>." + name, value);
}
inline void attribute(Tree& at, const std::string& name, const char* value) { attribute(at, name, std::string(value)); }
inline void attribute(Tree& at, const std::string& name, bool value) { attribute(at, name, value ? "true" : "false"); }
template <class Number>
requires std::is_arithmetic_v<Number>
void attribute(Tree& at, const std::string& name, Number value) { attribute(at, name, fmt::format("{}", value)); }
/// A child of this name behind all others.
inline Tree& child(Tree& parent, const std::string& name) { return parent.add_child(name, {}); }

inline std::string to_text(const Tree& root) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  write_xml(text, root, boost::property_tree::xml_writer_settings<std::string>(' ', 2));
  return text.str();
}

struct BaseExponents {
  int kg = 0, m = 0, s = 0, K = 0, A = 0, rad = 0;
};
/// What the units of the program are in base units, all of them SI.
inline const std::map<std::string, BaseExponents> base_units{
    {"s", {.s = 1}},
    {"Hz", {.s = -1}},
    {"m", {.m = 1}},
    {"m/s", {.m = 1, .s = -1}},
    {"1/m", {.m = -1}},
    {"s/m", {.m = -1, .s = 1}},
    {"kg", {.kg = 1}},
    {"N", {.kg = 1, .m = 1, .s = -2}},
    {"N/m", {.kg = 1, .s = -2}},
    {"N/s", {.kg = 1, .m = 1, .s = -3}},
    {"N s/m", {.kg = 1, .s = -1}},
    {"rad", {.rad = 1}},
    {"rad/s", {.s = -1, .rad = 1}},
    {"rad/s^2", {.s = -2, .rad = 1}},
    {"m/s^2", {.m = 1, .s = -2}},
    {"N m", {.kg = 1, .m = 2, .s = -2}},
    {"N m s", {.kg = 1, .m = 2, .s = -1}},
    {"N s", {.kg = 1, .m = 1, .s = -1}},
    {"N m/s", {.kg = 1, .m = 2, .s = -3}},
    {"N m/rad", {.kg = 1, .m = 2, .s = -2, .rad = -1}},
    {"N m s/rad", {.kg = 1, .m = 2, .s = -1, .rad = -1}},
    {"kg m^2", {.kg = 1, .m = 2}},
    {"1/(kg m^2)", {.kg = -1, .m = -2}},
    {"V", {.kg = 1, .m = 2, .s = -3, .A = -1}},
    {"A", {.A = 1}},
    {"ohm", {.kg = 1, .m = 2, .s = -3, .A = -2}},
    {"H", {.kg = 1, .m = 2, .s = -2, .A = -2}},
    {"N m/A", {.kg = 1, .m = 2, .s = -2, .A = -1}},
    {"V s/rad", {.kg = 1, .m = 2, .s = -2, .A = -1, .rad = -1}},
    {"V/(N m)", {.s = -1, .A = -1}},
    {"K", {.K = 1}},
    {"J/K", {.kg = 1, .m = 2, .s = -2, .K = -1}},
    {"K/W", {.kg = -1, .m = -2, .s = 3, .K = 1}},
    {"1/K", {.K = -1}},
};
/// The base units of a unit, or of one per second; nothing of a pure number.
inline std::optional<BaseExponents> base_exponents(const std::string& unit) {
  if (const auto known = base_units.find(unit); known != base_units.end()) return known->second;
  if (!unit.ends_with("/s")) return std::nullopt;
  const auto known = base_units.find(unit.substr(0, unit.size() - 2));
  BaseExponents rate = known == base_units.end() ? BaseExponents{} : known->second;
  --rate.s;
  return rate;
}
/// The attribute of a variable's unit, unless it is a pure number.
inline void state_unit(Tree& at, const VariableInfo& variable) {
  if (base_exponents(variable.unit)) attribute(at, "unit", variable.unit);
}

/// What alone an unknown depends on while the model runs, where that is known; numbers: of the variables by name.
template <class Number>
void state_dependencies(Tree& unknown, const VariableInfo& variable, const std::map<std::string, Number>& numbers) {
  if (!variable.depends_on) return;
  std::vector<Number> list;
  for (const std::string& name : *variable.depends_on) list.push_back(numbers.at(name));
  attribute(unknown, "dependencies", fmt::format("{}", fmt::join(list, " ")));
}

/// The units that the variables have.
inline void write_units(Tree& model, const std::vector<VariableInfo>& variables) {
  std::set<std::string> used;
  for (const VariableInfo& variable : variables)
    if (base_exponents(variable.unit)) used.insert(variable.unit);
  Tree& definitions = child(model, "UnitDefinitions");
  for (const std::string& name : used) {
    const BaseExponents e = *base_exponents(name);
    Tree& unit = child(definitions, "Unit");
    attribute(unit, "name", name);
    Tree& base = child(unit, "BaseUnit");
    for (const auto& [symbol, power] :
         {std::pair{"kg", e.kg}, {"m", e.m}, {"s", e.s}, {"K", e.K}, {"A", e.A}, {"rad", e.rad}})
      if (power != 0) attribute(base, symbol, power);
  }
}
inline void write_log_categories(Tree& model) {
  Tree& categories = child(model, "LogCategories");
  for (const std::string_view category : log_categories)
    attribute(child(categories, "Category"), "name", std::string(category));
}
inline void write_experiment(Tree& model, const RunSettings& run) {
  Tree& experiment = child(model, "DefaultExperiment");
  attribute(experiment, "startTime", "0");
  attribute(experiment, "stopTime", run.duration);
  attribute(experiment, "tolerance", run.relative_tolerance);
}
inline void write_origin(Tree& model, const Scenario& scenario) {
  attribute(model, "modelName", scenario.title);
  attribute(model, "description", "Worm-gear drive with stick, self-locking and flank changes as events");
  attribute(model, "generationTool", build_description());
  attribute(model, "generationDateAndTime", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))));
  attribute(model, "variableNamingConvention", "structured");
}

}  // namespace wormdrive
