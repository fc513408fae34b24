#include "bindings/fmi/json/control_json.hpp"

namespace wormdrive {
namespace {

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
  json["reference"] = terms_to_json(control.reference.terms, axis);
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
  control.reference.terms = terms_from_json<ReferenceTerm>(json.at("reference"), axis);
  return control;
}

}  // namespace wormdrive
