// modelDescription.xml of FMI 2.0.
#include <algorithm>

#include "bindings/fmi/archive/description_xml.hpp"
#include "bindings/fmi/archive/model_description.hpp"
#include "bindings/fmi/variables.hpp"

namespace wormdrive {
namespace {

/// indices: of the variables by name, counted from 1.
void write_fmi2_variable(Tree& list, const VariableInfo& variable, const std::map<std::string, std::size_t>& indices) {
  Tree& one = child(list, "ScalarVariable");
  attribute(one, "name", variable.name);
  attribute(one, "valueReference", variable.reference);
  attribute(one, "description", variable.description);
  attribute(one, "causality", variable.causality);
  attribute(one, "variability", variable.variability);
  if (variable.is_calculated()) attribute(one, "initial", "calculated");
  Tree& type = child(one, variable.whole ? "Integer" : "Real");
  state_unit(type, variable);
  if (variable.min) attribute(type, "min", *variable.min);
  if (variable.max) attribute(type, "max", *variable.max);
  if (variable.start) attribute(type, "start", *variable.start);
  if (variable.is_rate()) attribute(type, "derivative", indices.at(variable.derivative_of));
}

void write_fmi2_structure(Tree& structure, const std::vector<VariableInfo>& variables,
                          const std::map<std::string, std::size_t>& indices) {
  const auto list = [&](const char* group, bool running, auto&& belongs) {
    Tree& at = child(structure, group);
    for (std::size_t k = 0; k < variables.size(); ++k) {
      if (!belongs(variables[k])) continue;
      Tree& unknown = child(at, "Unknown");
      attribute(unknown, "index", k + 1);
      if (running) state_dependencies(unknown, variables[k], indices);
    }
  };
  list("Outputs", true, [](const VariableInfo& v) { return v.is_output(); });
  list("Derivatives", true, [](const VariableInfo& v) { return v.is_rate(); });
  list("InitialUnknowns", false, [](const VariableInfo& v) { return v.is_output() || v.is_rate(); });
}

}  // namespace

std::string fmi2_description(const FmuModel& model) {
  const std::vector<VariableInfo> variables = variables_of(model);
  const Offered has = offered(model);
  Tree root;
  Tree& top = child(root, "fmiModelDescription");
  attribute(top, "fmiVersion", "2.0");
  attribute(top, "guid", model.token);
  write_origin(top, model.scenario);
  if (has.model_exchange) {
    const InterfaceNames ports(model.scenario.effects);
    attribute(top, "numberOfEventIndicators", ports.indicators.size());
  }
  const auto interface = [&](const char* name) -> Tree& {
    Tree& type = child(top, name);
    attribute(type, "modelIdentifier", std::string(model_identifier));
    attribute(type, "canGetAndSetFMUstate", true);
    attribute(type, "canSerializeFMUstate", can_be_serialized(model));
    return type;
  };
  if (has.model_exchange) {
    Tree& type = interface("ModelExchange");
    attribute(type, "completedIntegratorStepNotNeeded", true);
    attribute(type, "providesDirectionalDerivative", true);
  }
  if (has.co_simulation) {
    Tree& type = interface("CoSimulation");
    attribute(type, "canHandleVariableCommunicationStepSize", true);
    attribute(type, "maxOutputDerivativeOrder", 1);
  }
  write_units(top, variables);
  write_log_categories(top);
  write_experiment(top, model.scenario.run);
  std::map<std::string, std::size_t> indices;
  for (const VariableInfo& variable : variables) indices[variable.name] = indices.size() + 1;
  Tree& list = child(top, "ModelVariables");
  for (const VariableInfo& variable : variables) write_fmi2_variable(list, variable, indices);
  write_fmi2_structure(child(top, "ModelStructure"), variables, indices);
  return to_text(root);
}

}  // namespace wormdrive
