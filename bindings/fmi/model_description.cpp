#include "bindings/fmi/model_description.hpp"

#include <locale>
#include <map>
#include <set>
#include <sstream>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bindings/fmi/plant_parameters.hpp"
#include "bindings/fmi/variables.hpp"
#include "core/elastic/elastic_teeth.hpp"
#include "output/program.hpp"

namespace wormdrive {
namespace {

using Tree = boost::property_tree::ptree;

void attribute(Tree& at, const std::string& name, const std::string& value) { at.put("<xmlattr>." + name, value); }
/// A child of this name behind all others.
Tree& child(Tree& parent, const std::string& name) { return parent.add_child(name, {}); }

struct BaseExponents {
  int kg = 0, m = 0, s = 0, rad = 0;
};
/// What the units of the program are in base units, all of them SI.
const std::map<std::string, BaseExponents> units{
    {"s", {.s = 1}},
    {"Hz", {.s = -1}},
    {"m", {.m = 1}},
    {"m/s", {.m = 1, .s = -1}},
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
    {"N m/s", {.kg = 1, .m = 2, .s = -3}},
    {"N m/rad", {.kg = 1, .m = 2, .s = -2, .rad = -1}},
    {"N m s/rad", {.kg = 1, .m = 2, .s = -1, .rad = -1}},
    {"kg m^2", {.kg = 1, .m = 2}},
};

/// Writes the variables in the order in which the structure counts them.
class DescriptionWriter {
 public:
  explicit DescriptionWriter(const Scenario& scenario)
      : scenario_(scenario), elastic_(has_elastic_teeth(scenario.effects)), ports_(elastic_) {}

  std::string write(const std::string& guid) {
    Tree root;
    Tree& model = child(root, "fmiModelDescription");
    attribute(model, "fmiVersion", "2.0");
    attribute(model, "modelName", scenario_.title);
    attribute(model, "guid", guid);
    attribute(model, "description", "Worm-gear drive with stick, self-locking and flank changes as events");
    attribute(model, "generationTool", build_description());
    attribute(model, "generationDateAndTime", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))));
    attribute(model, "variableNamingConvention", "structured");
    attribute(model, "numberOfEventIndicators", fmt::format("{}", ports_.indicators.size()));
    Tree& exchange = child(model, "ModelExchange");
    attribute(exchange, "modelIdentifier", std::string(model_identifier));
    attribute(exchange, "canGetAndSetFMUstate", "true");
    Tree variables, unit_definitions;
    write_variables(variables);
    for (const std::string& unit : used_) write_unit(unit_definitions, unit);
    model.add_child("UnitDefinitions", unit_definitions);
    Tree& category = child(child(model, "LogCategories"), "Category");
    attribute(category, "name", "logStatusError");
    Tree& experiment = child(model, "DefaultExperiment");
    attribute(experiment, "startTime", "0");
    attribute(experiment, "stopTime", fmt::format("{}", scenario_.run.duration));
    attribute(experiment, "tolerance", fmt::format("{}", scenario_.run.relative_tolerance));
    model.add_child("ModelVariables", variables);
    write_structure(child(model, "ModelStructure"));
    std::ostringstream text;
    text.imbue(std::locale::classic());
    write_xml(text, root, boost::property_tree::xml_writer_settings<std::string>(' ', 2));
    return text.str();
  }

 private:
  Tree& variable(Tree& list, const std::string& name, unsigned reference, const std::string& description) {
    Tree& one = child(list, "ScalarVariable");
    attribute(one, "name", name);
    attribute(one, "valueReference", fmt::format("{}", reference));
    attribute(one, "description", description);
    index_[name] = ++count_;
    return one;
  }
  /// kind: "output", "local", ...; a value that the model calculates.
  void real(Tree& list, const std::string& name, unsigned reference, const std::string& kind,
            const std::string& rotary_units, const std::string& description, const std::string& derivative_of = "") {
    Tree& one = variable(list, name, reference, in_words_of(scenario_.axis, description));
    attribute(one, "causality", kind);
    attribute(one, "variability", "continuous");
    attribute(one, "initial", "calculated");
    Tree& type = child(one, "Real");
    state_units(type, rotary_units);
    if (!derivative_of.empty()) attribute(type, "derivative", fmt::format("{}", index_.at(derivative_of)));
  }
  void state_units(Tree& type, const std::string& rotary) {
    const std::string units_here =
        rotary == "rad/s^2" && scenario_.axis == Axis::linear ? "m/s^2" : units_on(scenario_.axis, rotary);
    use(type, units_here);
  }
  void use(Tree& type, const std::string& unit) {
    if (!units.contains(unit)) return;  // a pure number
    attribute(type, "unit", unit);
    used_.insert(unit);
  }
  void whole(Tree& list, const std::string& name, ScalarVariable reference, const std::string& description) {
    Tree& one = variable(list, name, static_cast<unsigned>(reference), description);
    attribute(one, "causality", "output");
    attribute(one, "variability", "discrete");
    attribute(one, "initial", "calculated");
    Tree& type = child(one, "Integer");
    attribute(type, "min", "-1");
    attribute(type, "max", "1");
  }
  void shaft(Tree& list, const std::string& name, ScalarVariable angle, ScalarVariable speed, ScalarVariable angle_rate,
             ScalarVariable speed_rate) {
    const auto ref = [](ScalarVariable v) { return static_cast<unsigned>(v); };
    real(list, name + "_angle", ref(angle), "output", "rad", name + " angle");
    real(list, name + "_speed", ref(speed), "output", "rad/s", name + " speed; exactly 0 while stuck");
    real(list, "der(" + name + "_angle)", ref(angle_rate), "local", "rad/s", "rate of the " + name + " angle",
         name + "_angle");
    real(list, "der(" + name + "_speed)", ref(speed_rate), "local", "rad/s^2", "acceleration of the " + name,
         name + "_speed");
    states_.push_back(name);
  }

  void write_variables(Tree& list) {
    using enum ScalarVariable;
    if (elastic_) shaft(list, "worm", worm_angle, worm_speed, worm_angle_rate, worm_speed_rate);
    shaft(list, "gear", gear_angle, gear_speed, gear_angle_rate, gear_speed_rate);
    Tree& input = variable(list, "motor_torque", static_cast<unsigned>(motor_torque),
                           in_words_of(scenario_.axis, "motor torque before the effects of the actuator"));
    attribute(input, "causality", "input");
    attribute(input, "variability", "continuous");
    Tree& type = child(input, "Real");
    state_units(type, "N m");
    attribute(type, "start", "0");
    real(list, "normal_force", static_cast<unsigned>(normal_force), "output", "N", "normal force between the teeth");
    real(list, "measured_angle", static_cast<unsigned>(measured_angle), "output", "rad",
         "gear angle as the sensor measures it");
    whole(list, "motion", motion, "-1 backward, 0 stuck, 1 forward; of elastic teeth the worm");
    whole(list, "flank", flank, "flank that carries: -1 right, 0 none, 1 left");
    if (elastic_) whole(list, "gear_motion", gear_motion, "-1 backward, 0 stuck, 1 forward");
    for (unsigned k = 0; k < ports_.indicators.size(); ++k) {
      std::string name = "indicator." + std::string(ports_.indicators[k]);
      for (char& c : name)
        if (c == ' ' || c == '-') c = '_';
      real(list, name, first_indicator + k, "local", "1",
           fmt::format("event indicator {}: positive while the mode holds; 1 where the mode has none", k + 1));
    }
    unsigned reference = first_parameter;
    for_each_plant_parameter(scenario_, [&](const std::string& path, const auto& field, const double& value) {
      const Spelling s = si_spelling(field, scenario_.axis);
      Tree& one = variable(list, path + "." + s.key, reference++, in_words_of(scenario_.axis, field.meaning));
      attribute(one, "causality", "parameter");
      attribute(one, "variability", "fixed");
      Tree& real = child(one, "Real");
      use(real, std::string(s.unit.symbol));
      if (std::isfinite(field.bounds.low)) attribute(real, "min", fmt::format("{}", field.bounds.low));
      if (std::isfinite(field.bounds.high)) attribute(real, "max", fmt::format("{}", field.bounds.high));
      attribute(real, "start", fmt::format("{}", value));
    });
  }

  void write_unit(Tree& definitions, const std::string& name) {
    const BaseExponents e = units.at(name);
    Tree& unit = child(definitions, "Unit");
    attribute(unit, "name", name);
    Tree& base = child(unit, "BaseUnit");
    for (const auto& [symbol, power] : {std::pair{"kg", e.kg}, {"m", e.m}, {"s", e.s}, {"rad", e.rad}})
      if (power != 0) attribute(base, symbol, fmt::format("{}", power));
  }

  void write_structure(Tree& structure) {
    std::vector<std::string> outputs, rates;
    for (const std::string& name : states_) {
      outputs.insert(outputs.end(), {name + "_angle", name + "_speed"});
      rates.insert(rates.end(), {"der(" + name + "_angle)", "der(" + name + "_speed)"});
    }
    outputs.insert(outputs.end(), {"normal_force", "measured_angle", "motion", "flank"});
    if (elastic_) outputs.push_back("gear_motion");
    const auto list = [&](const std::string& group, const std::vector<std::string>& names) {
      Tree& at = child(structure, group);
      for (const std::string& name : names)
        attribute(child(at, "Unknown"), "index", fmt::format("{}", index_.at(name)));
    };
    list("Outputs", outputs);
    list("Derivatives", rates);
    std::vector<std::string> initial = outputs;
    initial.insert(initial.end(), rates.begin(), rates.end());
    std::sort(initial.begin(), initial.end(),
              [&](const std::string& a, const std::string& b) { return index_.at(a) < index_.at(b); });
    list("InitialUnknowns", initial);
  }

  const Scenario& scenario_;
  const bool elastic_;
  const InterfaceNames ports_;
  std::map<std::string, int> index_;  ///< of every variable, counted from 1
  int count_ = 0;
  std::vector<std::string> states_;
  std::set<std::string> used_;  ///< units
};

}  // namespace

std::string model_description(const Scenario& scenario, const std::string& guid) {
  return DescriptionWriter(scenario).write(guid);
}

}  // namespace wormdrive
