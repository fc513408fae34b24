#include "diagnosis/report/diagnosis_json.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "description/keys.hpp"
#include "diagnosis/verdict/certificate.hpp"
#include "output/program.hpp"

namespace wormdrive {
namespace {

using nlohmann::json;

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }
/// Unit of a value in SI, as printed: degrees are told in rad.
std::string si_symbol(const Unit& unit) {
  if (unit.suffix == "deg") return std::string(unit::radian.symbol);
  return unit.si == 1.0 ? std::string(unit.symbol) : std::string(unit::none.symbol);
}

json as_json(const Estimate& e) {
  return {{"name", e.field},      {"value", number(e.value)}, {"standard_error", number(e.standard_error)},
          {"low", number(e.low)}, {"high", number(e.high)},   {"unit", si_symbol(e.unit)}};
}

json as_json(const EstimatedEffect& effect) {
  json parameters = json::array();
  for (const Estimate& e : effect.parameters) parameters.push_back(as_json(e));
  return {{"effect", effect.effect}, {"parameters", parameters}};
}

json cause_as_json(const EstimatedEffect& cause) {
  json made = as_json(cause);
  made["remedy"] = cause.remedy.empty() ? json(nullptr) : json(cause.remedy);
  return made;
}

json as_json(const JointEstimate& u) {
  json numbers = json::array();
  for (std::size_t k = 0; k < u.numbers.size(); ++k) {
    numbers.push_back(as_json(u.numbers[k]));
    numbers.back()["effect"] = u.effects[k];
  }
  return {{"parameters", numbers}, {"correlation", u.correlation}};
}

json as_json(const RankedCandidate& c) {
  json made = as_json(c.effect);
  made["delta_bic"] = number(c.delta_bic);
  made["held_out_gain_nats"] = number(c.held_out_gain);
  made["named"] = c.named;
  made["outcome"] = c.outcome;
  return made;
}

json as_json(const PredictionError& e) {
  return {{"horizon_s", number(e.horizon)},
          {"before", number(e.before)},
          {"after", number(e.after)},
          {"after_low", number(e.after_low)},
          {"after_high", number(e.after_high)},
          {"noise_floor", number(e.floor)},
          {"constant_speed", number(e.constant_speed)},
          {"unit", si_symbol(e.unit)}};
}

json as_json(const Visibility& v) {
  return {{"effect", v.effect},
          {"parameter", v.field},
          {"chosen", v.chosen.empty() ? json(nullptr) : json(v.chosen)},
          {"unit", si_symbol(v.unit)},
          {"observable", v.observable},
          {"detectable", number(v.detectable)},
          {"nameable", number(v.nameable)},
          {"nearest", v.nearest.empty() ? json(nullptr) : json(v.nearest)},
          {"likeness", number(v.likeness)}};
}

json as_json(const Change& c) {
  return {{"effect", c.effect},
          {"before", as_json(c.before)},
          {"after", as_json(c.after)},
          {"difference", as_json(c.difference)},
          {"certain", c.certain}};
}

/// A key with its unit as it is on an axis: "torque_Nm" or "force_N".
std::string key(std::string_view name, const Unit& unit, Axis axis) { return spellings(name, unit, axis).front().key; }

json remainders(const Diagnosis& d) {
  json all = json::array();
  for (const Remainder& r : d.remainders)
    all.push_back({{"axis", r.axis},
                   {"evidence", number(r.evidence)},
                   {key("torque", unit::newton_metre, d.extended.axis), number(r.torque)},
                   {"gain", number(r.gain)}});
  return all;
}

template <class List>
json list_of(const List& list) {
  json all = json::array();
  for (const auto& item : list) all.push_back(as_json(item));
  return all;
}

json as_json(const Since& since) {
  return {{"files", since.files},
          {"verdict", name(since.verdict)},
          {"sentence", since.sentence},
          {"changes", list_of(since.changes)}};
}

}  // namespace

std::string name(Verdict verdict) {
  switch (verdict) {
    case Verdict::adequate: return "adequate";
    case Verdict::named: return "named";
    case Verdict::ambiguous: return "ambiguous";
    case Verdict::unexplained: return "unexplained";
  }
  return "";
}

nlohmann::json as_json(const Diagnosis& d, const std::string& data_kind, const std::vector<std::string>& files) {
  json causes = json::array();
  for (const EstimatedEffect& cause : d.causes) causes.push_back(cause_as_json(cause));
  return {{"verdict", name(d.verdict)},
          {"sentence", d.sentence},
          {"data", {{"kind", data_kind}, {"files", files}}},
          {"causes", causes},
          {"classes", d.classes},
          {"ranking", list_of(d.ranking)},
          {"gain", list_of(d.prediction)},
          {"calibration", list_of(d.calibration)},
          {"uncertainty", as_json(d.uncertainty)},
          {"identified", list_of(d.identified)},
          {"certificate", list_of(d.certificate)},
          {"unobservable", unobservable(d.certificate)},
          {"adequacy", remainders(d)},
          {"noise",
           {{key("torque", unit::newton_metre, d.extended.axis), number(d.noise_torque)},
            {key("angle", unit::radian, d.extended.axis), number(d.noise_angle)}}},
          {"experiment", d.experiment_reason.empty() ? json(nullptr) : json(d.experiment_reason)},
          {"since", d.since ? as_json(*d.since) : json(nullptr)},
          {"remarks", d.remarks},
          {"settings", {{"seed", d.seed}, {"passes", d.passes}}},
          {"program", build_description()}};
}

}  // namespace wormdrive
