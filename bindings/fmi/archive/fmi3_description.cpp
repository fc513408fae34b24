// modelDescription.xml and terminalsAndIcons.xml of FMI 3.0.
#include <algorithm>

#include "bindings/fmi/archive/description_xml.hpp"
#include "bindings/fmi/archive/model_description.hpp"
#include "bindings/fmi/variables.hpp"

namespace wormdrive {
namespace {

constexpr const char* fmi3_version = "3.0";

/// references: of the variables by name.
void write_fmi3_variable(Tree& list, const VariableInfo& variable, const std::map<std::string, unsigned>& references) {
  Tree& one = child(list, variable.whole ? "Int32" : "Float64");
  attribute(one, "name", variable.name);
  attribute(one, "valueReference", variable.reference);
  attribute(one, "description", variable.description);
  attribute(one, "causality", variable.causality);
  attribute(one, "variability", variable.variability);
  if (variable.is_calculated()) attribute(one, "initial", "calculated");
  if (variable.start) attribute(one, "start", *variable.start);
  state_unit(one, variable);
  if (variable.min) attribute(one, "min", *variable.min);
  if (variable.max) attribute(one, "max", *variable.max);
  if (variable.sampled) attribute(one, "clocks", static_cast<unsigned>(ScalarVariable::sample_clock));
  if (variable.is_rate()) attribute(one, "derivative", references.at(variable.derivative_of));
}

/// Its interval and shift follow from parameters: importers ask for them.
void write_sample_clock(Tree& list) {
  Tree& one = child(list, "Clock");
  attribute(one, "name", "controller.sample");
  attribute(one, "valueReference", static_cast<unsigned>(ScalarVariable::sample_clock));
  attribute(one, "description", "the controller takes a sample");
  attribute(one, "causality", "input");
  attribute(one, "variability", "discrete");
  attribute(one, "intervalVariability", "fixed");
}

void write_fmi3_structure(Tree& structure, const std::vector<VariableInfo>& variables,
                          const std::map<std::string, unsigned>& references) {
  const auto list = [&](const char* group, bool running, auto&& belongs) {
    for (const VariableInfo& variable : variables) {
      if (!belongs(variable)) continue;
      Tree& unknown = child(structure, group);
      attribute(unknown, "valueReference", variable.reference);
      if (running) state_dependencies(unknown, variable, references);
    }
  };
  list("Output", true, [](const VariableInfo& v) { return v.is_output(); });
  list("ContinuousStateDerivative", true, [](const VariableInfo& v) { return v.is_rate(); });
  list("InitialUnknown", false, [](const VariableInfo& v) { return v.is_output() || v.is_rate(); });
  list("EventIndicator", false,
       [](const VariableInfo& v) { return v.reference >= first_indicator && v.reference < first_effect_state; });
}

}  // namespace

std::string fmi3_description(const FmuModel& model) {
  const std::vector<VariableInfo> variables = variables_of(model);
  const Offered has = offered(model);
  Tree root;
  Tree& top = child(root, "fmiModelDescription");
  attribute(top, "fmiVersion", fmi3_version);
  attribute(top, "instantiationToken", model.token);
  write_origin(top, model.scenario);
  const auto interface = [&](const char* name) -> Tree& {
    Tree& type = child(top, name);
    attribute(type, "modelIdentifier", std::string(model_identifier));
    attribute(type, "canGetAndSetFMUState", true);
    attribute(type, "canSerializeFMUState", can_be_serialized(model));
    return type;
  };
  if (has.model_exchange) {
    Tree& type = interface("ModelExchange");
    for (const char* can : {"providesDirectionalDerivatives", "providesAdjointDerivatives"}) attribute(type, can, true);
  }
  if (has.co_simulation) {
    Tree& type = interface("CoSimulation");
    for (const char* can : {"canHandleVariableCommunicationStepSize", "providesIntermediateUpdate",
                            "mightReturnEarlyFromDoStep", "canReturnEarlyAfterIntermediateUpdate", "hasEventMode"})
      attribute(type, can, true);
    attribute(type, "maxOutputDerivativeOrder", 1);
  }
  write_units(top, variables);
  write_log_categories(top);
  write_experiment(top, model.scenario.run);
  std::map<std::string, unsigned> references;
  for (const VariableInfo& variable : variables) references[variable.name] = variable.reference;
  Tree& list = child(top, "ModelVariables");
  for (const VariableInfo& variable : variables) write_fmi3_variable(list, variable, references);
  if (model.scenario.control) write_sample_clock(list);
  write_fmi3_structure(child(top, "ModelStructure"), variables, references);
  return to_text(root);
}

std::string fmi3_terminals(const FmuModel& model) {
  Tree root;
  Tree& top = child(root, "fmiTerminalsAndIcons");
  attribute(top, "fmiVersion", fmi3_version);
  Tree& list = child(top, "Terminals");
  const auto terminal = [&](const char* name, const char* description,
                            const std::vector<std::pair<std::string, std::string>>& members) {
    Tree& one = child(list, "Terminal");
    attribute(one, "name", name);
    attribute(one, "matchingRule", "plug");
    attribute(one, "description", description);
    for (const auto& [variable, member] : members) {
      Tree& at = child(one, "TerminalMemberVariable");
      attribute(at, "variableName", variable);
      attribute(at, "memberName", member);
      attribute(at, "variableKind", "signal");
    }
  };
  if (model.kind == FmuKind::plant) terminal("motor", "the worm's shaft", {{"motor_torque", "torque"}});
  terminal("gear", "the gear's shaft", {{"gear_angle", "angle"}, {"gear_speed", "speed"}});
  return to_text(root);
}

}  // namespace wormdrive
