#include "bindings/fmi/json/control_json.hpp"

namespace wormdrive {
namespace {

Json reference_to_json(const ReferenceTerm& term, Axis axis) {
  return std::visit(
      [&]<class Kind>(const Kind& reference) {
        Json at = kind_to_json(reference, axis);
        if constexpr (requires { reference.table; }) {
          at["times"] = reference.table.points();
          at["angles"] = reference.table.values();
        }
        return at;
      },
      term);
}
ReferenceTerm reference_from_json(Json& at, Axis axis) {
  ReferenceTerm term = make_kind<ReferenceTerm>(at.at("kind").get<std::string>());
  std::visit(
      [&](auto& reference) {
        if constexpr (requires { reference.table; })
          reference.table = CubicTable(at.at("times").template get<std::vector<double>>(),
                                       at.at("angles").template get<std::vector<double>>());
        else
          transfer(Reader{axis}, at, reference);
      },
      term);
  return term;
}

/// Calls pass(key, parameters) for every table but the law and the reference.
template <class Control, class Pass>
void for_each_plain_table(Control& control, Pass&& pass) {
  pass("sampling", control.sampling);
  pass("anti_windup", control.anti_windup);
  pass("nominal", control.nominal);
  pass("variation", control.variations);
  pass("sensor", control.sensor);
  pass("disturbance", control.disturbance);
}

}  // namespace

Json control_to_json(const ControlScenario& control, Axis axis) {
  Json json = Json::object();
  for_each_plain_table(control, [&](const char* key, const auto& parameters) {
    json[key] = Json::object();
    transfer(Writer{axis}, json[key], parameters);
  });
  json["law"] = std::visit(
      [&](const auto& law) {
        Json at = kind_to_json(law, axis);
        if constexpr (requires { law.torque.terms; }) at["torque"] = terms_to_json(law.torque.terms, axis);
        return at;
      },
      control.law);
  json["reference"] = Json::array();
  for (const ReferenceTerm& term : control.reference.terms) json["reference"].push_back(reference_to_json(term, axis));
  return json;
}

ControlScenario control_from_json(Json& json, Axis axis) {
  ControlScenario control;
  for_each_plain_table(control,
                       [&](const char* key, auto& parameters) { transfer(Reader{axis}, json.at(key), parameters); });
  Json& stated = json.at("law");
  control.law = make_kind<ControllerParameters>(stated.at("kind").get<std::string>());
  std::visit(
      [&](auto& law) {
        if constexpr (requires { law.torque.terms; })
          law.torque.terms = terms_from_json<SignalTerm>(stated.at("torque"), axis);
        else
          transfer(Reader{axis}, stated, law);
      },
      control.law);
  for (Json& term : json.at("reference")) control.reference.terms.push_back(reference_from_json(term, axis));
  return control;
}

}  // namespace wormdrive
