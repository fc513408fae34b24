#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <toml++/toml.h>

#include "cli/bad_input.hpp"
#include "core/effects.hpp"
#include "description/diagnostics.hpp"
#include "description/keys.hpp"
#include "description/toml/document.hpp"
#include "description/toml/write_scenario.hpp"
#include "simulation/load_scenario.hpp"

// The schema against which editors check a scenario takes every scenario that the program takes.

namespace wormdrive::test::cli_schema_validation {

using nlohmann::json;

namespace {

/// A TOML document as JSON, as an editor sees it.
json as_json(const toml::node& node) {
  if (const auto* table = node.as_table()) {
    json all = json::object();
    for (const auto& [key, value] : *table) all[std::string(key.str())] = as_json(value);
    return all;
  }
  if (const auto* array = node.as_array()) {
    json all = json::array();
    for (const toml::node& value : *array) all.push_back(as_json(value));
    return all;
  }
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto truth = node.value_exact<bool>()) return *truth;
  return node.value<double>().value();
}

/// Why a value breaks a schema; empty if it keeps it. The keywords are those that the schema of a scenario uses.
const std::string accepted;  ///< what is said of a document that keeps to its schema

std::string broken(const json& schema, const json& value, const std::string& at);

int kept(const json& all, const json& value, const std::string& at) {
  int count = 0;
  for (const json& one : all) count += broken(one, value, at).empty() ? 1 : 0;
  return count;
}

std::string broken(const json& schema, const json& value, const std::string& at) {
  static const std::set<std::string> known{"$schema",
                                           "title",
                                           "description",
                                           "default",
                                           "type",
                                           "enum",
                                           "const",
                                           "properties",
                                           "additionalProperties",
                                           "required",
                                           "items",
                                           "minItems",
                                           "maxItems",
                                           "minLength",
                                           "minimum",
                                           "maximum",
                                           "multipleOf",
                                           "exclusiveMinimum",
                                           "exclusiveMaximum",
                                           "oneOf",
                                           "anyOf",
                                           "allOf",
                                           "if",
                                           "then",
                                           "else"};
  for (const auto& [key, rule] : schema.items()) {
    if (known.count(key) == 0) return "unknown keyword " + key;
    const auto is = [&](const char* type) { return schema.value("type", "") == type; };
    if (key == "type" && !((is("object") && value.is_object()) || (is("array") && value.is_array()) ||
                           (is("string") && value.is_string()) || (is("boolean") && value.is_boolean()) ||
                           (is("number") && value.is_number())))
      return at + " is no " + rule.get<std::string>();
    if (key == "const" && value != rule) return at + " is not " + rule.dump();
    if (key == "enum" && std::find(rule.begin(), rule.end(), value) == rule.end())
      return at + " is not one of " + rule.dump();
    if (value.is_number()) {
      const double x = value;
      if ((key == "minimum" && x < rule) || (key == "maximum" && x > rule) ||
          (key == "exclusiveMinimum" && x <= rule) || (key == "exclusiveMaximum" && x >= rule))
        return fmt::format("{} = {} breaks {}", at, x, key);
      if (key == "multipleOf" && std::remainder(x, rule.get<double>()) != 0.0)
        return fmt::format("{} = {} breaks {}", at, x, key);
    }
    if (value.is_string() && key == "minLength" && value.get<std::string>().size() < rule) return at + " is too short";
    if (value.is_array()) {
      if ((key == "minItems" && value.size() < rule) || (key == "maxItems" && value.size() > rule))
        return at + ": " + key;
      if (key == "items")
        for (const json& item : value)
          if (const std::string why = broken(rule, item, at + "[]"); !why.empty()) return why;
    }
    if (value.is_object()) {
      if (key == "required")
        for (const json& name : rule)
          if (!value.contains(name.get<std::string>())) return at + " lacks " + name.get<std::string>();
      if (key == "properties")
        for (const auto& [name, property] : value.items())
          if (rule.contains(name))
            if (const std::string why = broken(rule.at(name), property, at + "." + name); !why.empty()) return why;
      if (key == "additionalProperties")
        for (const auto& [name, property] : value.items())
          if (!schema.at("properties").contains(name)) return at + " knows no " + name;
    }
    if (key == "allOf")
      for (const json& one : rule)
        if (const std::string why = broken(one, value, at); !why.empty()) return why;
    if (key == "anyOf" && kept(rule, value, at) == 0) return at + " keeps none of anyOf";
    if (key == "oneOf" && kept(rule, value, at) != 1)
      return fmt::format("{} keeps {} of oneOf", at, kept(rule, value, at));
    if (key == "if") {
      const char* const branch = broken(rule, value, at).empty() ? "then" : "else";
      if (const std::string why = broken(schema.at(branch), value, at); !why.empty()) return why;
    }
  }
  return "";
}

const json& schema() {
  static const json all = json::parse(Folder().run({"schema"}).out);
  return all;
}
std::string broken(const std::string& text) { return broken(schema(), as_json(toml::parse(text)), "scenario"); }

/// A table with every field of a parameter struct, each with a value within its bounds.
template <class Parameters>
std::string every_field(const std::string& header, Axis axis) {
  std::string text = header + "\n";
  for_each_field<Parameters>([&](const auto& field) {
    const Spelling s = spellings(field.name, field.unit, axis).front();
    const Bounds& b = field.bounds;
    const double low = std::max(b.low, -1.0), high = std::min(b.high, low + 2.0);
    const bool whole = field.unit.whole;
    text += fmt::format("{} = {}\n", s.key, whole ? 2.0 : (low + 0.25 * (high - low)) / s.unit.si);
  });
  return text;
}

/// Tables that any scenario of an axis may have beside those of its drive.
std::string every_table(Axis axis) {
  std::string limits = every_field<ExperimentLimits>("[limits]", axis);
  limits.erase(limits.rfind('-'), 1);  // the highest angle is above the lowest
  std::string text =
      every_field<InitialState<double>>("[initial]", axis) + every_field<Tolerances>("[tolerance]", axis) + limits;
  const bool turns = axis == Axis::rotary;
  text += fmt::format("[effect.torque_map]\nscale = 2\nover = \"gear_angle\"\n{} = [0, 1, 2, 3]\n{} = [1, 2, 3, 2]\n",
                      turns ? "angles_deg" : "positions_m", turns ? "torques_Nm" : "forces_N");
  text += "[data]\n";
  for (const RecordedColumn& column : recorded_columns)
    text += fmt::format("{} = \"column {}\"\n", spellings(column.name, column.unit, axis).front().key, column.name);
  return text;
}

const std::string sledge =
    "[mesh]\nkind = \"none\"\naxis = \"linear\"\nmass_kg = 2\n[motor.torque]\nkind = \"constant\"\nforce_N = 1\n"
    "[run]\nduration_s = 0.01\n";

}  // namespace

TEST_CASE("the schema accepts every shipped scenario, with and without its defaults") {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(WORMDRIVE_SCENARIOS)) {
    if (entry.path().extension() != ".toml") continue;
    INFO(entry.path());
    CHECK(broken(read_text(entry.path().string())) == accepted);
    CHECK(broken(to_toml(load_scenario(entry.path().string(), {}, Purpose::look))) == accepted);
    ++count;
  }
  CHECK(count > 15);
}

TEST_CASE("the schema of studies accepts what the reader accepts, and every distribution and design") {
  const json studies = json::parse(Folder().run({"schema", "--kind", "study"}).out);
  const auto why = [&](const std::string& text) { return broken(studies, as_json(toml::parse(text)), "study"); };
  for (const auto& entry : std::filesystem::directory_iterator(WORMDRIVE_SCENARIOS "/studies"))
    if (entry.path().extension() == ".toml") {
      INFO(entry.path());
      CHECK(why(read_text(entry.path().string())) == accepted);
    }
  const std::string begin = "scenario = \"s.toml\"\n", path = "\n[[parameter]]\npath = \"mesh.friction\"\n",
                    uniform = path + "distribution = \"uniform\"\nlow = 0.1\nhigh = 0.2\n",
                    draws = "[sweep]\ndesign = \"monte_carlo\"\ntrials = 5\n";
  for (const char* const keys :
       {"\"uniform\"\nlow = 0\nhigh = 1", "\"normal\"\nmean = 0\ndeviation = 1",
        "\"truncated_normal\"\nmean = 0\ndeviation = 1\nlow = 0", "\"lognormal\"\nmedian = 1\nlog_deviation = 1",
        "\"triangular\"\nlow = 0\nmode = 0\nhigh = 1", "\"discrete\"\nvalues = [1]",
        "\"table\"\nvalues = [1, 2]\nprobabilities = [0, 1]", "\"log_uniform\"\nlow = 1\nhigh = 2",
        "\"beta\"\nalpha = 1\nbeta = 2\nlow = 0\nhigh = 1", "\"pert\"\nlow = 0\nmode = 0\nhigh = 1",
        "\"gumbel\"\nmode = 0\nscale = 1", "\"weibull\"\nshape = 1\nscale = 1",
        "\"empirical\"\nfile = \"m.csv\"\ncolumn = \"mu\""}) {
    INFO(keys);
    CHECK(why(begin + draws + path + "distribution = " + keys + "\n") == accepted);
    CHECK(why(begin + draws + path + "distribution = " + keys + "\nmedain = 1\n") != accepted);
  }
  for (const char* const keys :
       {"\"latin_hypercube\"\ntrials = 5", "\"sobol\"\ntrials = 5", "\"saltelli\"\nsamples = 2\nsecond_order = true",
        "\"grid\"", "\"shapley\"\npermutations = 8", "\"one_at_a_time\"\nlevels = 2",
        "\"morris\"\ntrajectories = 4\nlevels = 6"}) {
    INFO(keys);
    CHECK(why(begin + "[sweep]\ndesign = " + keys + "\n" + uniform) == accepted);
    CHECK(why(begin + "[sweep]\nsead = 1\ndesign = " + keys + "\n" + uniform) != accepted);
  }
  CHECK(why(begin + "[sweep]\ndesign = \"table\"\nfile = \"p.csv\"" + path + "column = \"mu\"\n") == accepted);
  CHECK(why(begin + draws) != accepted);
}

TEST_CASE("the schema accepts every table that the reader accepts, on either axis") {
  for (const auto& [axis, drive] : {std::pair{Axis::rotary, good_scenario}, {Axis::linear, sledge}}) {
    const std::string text = drive + every_table(axis);
    INFO(text);
    CHECK_NOTHROW(parse_scenario(text, "all", {}, Purpose::run));
    CHECK(broken(text) == accepted);
    CHECK(broken(to_toml(parse_scenario(text, "all", {}, Purpose::run))) == accepted);
  }
  const auto without_run = [](std::string text) { return text.substr(0, text.find("[run]")); };
  CHECK(broken(without_run(good_scenario) + "[tolerance]\nload_share = 0.01\n") == accepted);
}

TEST_CASE("the root of the schema has the tables of the reader, on either axis") {
  for (const auto& [branch, drive] : {std::pair{"else", good_scenario}, {"then", sledge}}) {
    const Folder folder;
    folder.write("s.toml", "zzzzzzzzzzzzzzzzzzzz = 1\n" + drive);
    const std::string said = folder.run({"check", "s.toml"}).err, mark = "; valid keys: ";
    std::set<std::string> told, known;
    std::istringstream list(said.substr(std::min(said.size(), said.find(mark) + mark.size())));
    for (std::string key; list >> key;) told.insert(key.substr(0, key.find(',')));
    if (branch == std::string("then"))  // where a controller is refused by its name
      for (const char* const key : {"controller", "reference", "sensor", "disturbance", "metrics"}) told.erase(key);
    for (const auto& [key, table] : schema().at(branch).at("properties").items()) known.insert(key);
    if (branch == std::string("else"))  // which belong to a controller
      for (const char* const key : {"reference", "sensor", "disturbance", "metrics"}) known.erase(key);
    INFO(said);
    CHECK(told == known);
  }
}

TEST_CASE("the schema rejects what the reader rejects") {
  for (const std::string& text :
       {good_scenario + "[tolerance]\nload_percent = -1\n", good_scenario + "[tolerance]\nlaod_percent = 1\n",
        good_scenario + "[data]\ntime_s = \"\"\n", good_scenario + "[data]\ntime = \"t\"\n",
        sledge + "[tolerance]\nworm_inertia_percent = 1\n", sledge + "[data]\nmotor_torque_Nm = \"u\"\n"}) {
    INFO(text);
    CHECK(broken(text) != accepted);
    CHECK_THROWS_AS(parse_scenario(text, "bad", {}, Purpose::run), InputFault);
  }
}

TEST_CASE("on a linear axis messages name only tolerance keys that the reader accepts") {
  const Folder folder;
  folder.write("s.toml", sledge + "[tolerance]\nzzzzzzzzzzzzzzzzzzzz = 1\n");
  const std::string said = folder.run({"check", "s.toml"}).err, mark = "; valid keys: ";
  std::istringstream list(said.substr(std::min(said.size(), said.find(mark) + mark.size())));
  int count = 0;
  for (std::string key; list >> key; ++count) {
    INFO(key);
    CHECK(key.find("inertia") == std::string::npos);
    CHECK(key.find("torque") == std::string::npos);
    CHECK_NOTHROW(parse_scenario(sledge + "[tolerance]\n" + key.substr(0, key.find(',')) + " = 0.1\n", "linear", {},
                                 Purpose::run));
  }
  CHECK(count == 13);
  check_rejected(folder,
                 {{"unit forgotten", sledge + "[tolerance]\nworm_mass = 1\n",
                   "s.toml:11:1: error: unknown key 'worm_mass' in [tolerance]; did you mean 'worm_mass_share'?"},
                  {"misspelled", sledge + "[tolerance]\nworm_mas_percent = 1\n",
                   "s.toml:11:1: error: unknown key 'worm_mas_percent' in [tolerance]; did you mean "
                   "'worm_mass_percent'?"}});
}

}  // namespace wormdrive::test::cli_schema_validation
