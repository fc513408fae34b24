#include "description/toml/write_scenario.hpp"

#include <cmath>
#include <locale>
#include <sstream>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "description/keys.hpp"
#include "description/number_text.hpp"

namespace wormdrive {
namespace {

/// A double as TOML writes it: never as an integer.
std::string as_float(std::string text) { return text.find_first_of(".en") == std::string::npos ? text + ".0" : text; }

/// Shortest text that reads back as the same double.
std::string number(double value) { return as_float(fmt::format("{}", value)); }

/// A number with its key and unit.
struct Statement {
  std::string key, number;
};

/// How a value is stated: in the preferred unit if that gives the same bits when read, else in SI. 30 deg come back
/// from radians as 29.999999999999996: where fifteen digits do, they are what was meant.
Statement exactly(double si, const std::vector<Spelling>& accepted) {
  for (const Spelling& s : accepted)
    for (const std::string& text : {as_float(fmt::format("{:.15g}", si / s.unit.si)), number(si / s.unit.si)})
      if (number_in(text).value_or(0.0) * s.unit.si == si) return {s.key, text};
  return {accepted.back().key, number(si)};
}

class Writer {
 public:
  explicit Writer(Axis axis) : axis_(axis) {}

  void table(const std::string& header) { text_ += fmt::format("\n{}\n", header); }
  void text(const std::string& key, const std::string& value) {
    std::ostringstream quoted;  // toml++ knows how to quote
    quoted.imbue(std::locale::classic());
    quoted << toml::node_view<const toml::node>(toml::value<std::string>(value));
    text_ += fmt::format("{} = {}\n", key, quoted.str());
  }
  template <class Parameters>
  void fields(const Parameters& parameters) {
    for_each_field<Parameters>([&](const auto& field) { value(field.name, field.unit, parameters.*field.member); });
  }
  void value(std::string_view name, const Unit& unit, const std::optional<double>& si) {
    if (!si || !std::isfinite(*si)) return;  // an infinite default is stated by absence
    const Statement s = exactly(*si, spellings(name, unit, axis_));
    text_ += fmt::format("{} = {}\n", s.key, s.number);
  }
  void values(std::string_view name, const Unit& unit, const std::vector<double>& si) {
    const Spelling s = spellings(name, unit, axis_).front();
    text_ += fmt::format("{} = [", s.key);
    for (std::size_t k = 0; k < si.size(); ++k) text_ += fmt::format("{}{}", k == 0 ? "" : ", ", number(si[k]));
    text_ += "]\n";
  }
  std::string take() { return std::move(text_); }

 private:
  Axis axis_;
  std::string text_;
};

void write_parameters(Writer& out, const Samples& samples) {
  out.text("interpolation", samples.interpolation == Interpolation::linear ? "linear" : "hold");
  out.values("times", unit::second, samples.times);
  out.values("torques", unit::newton_metre, samples.values);
}
void write_parameters(Writer& out, const AngleTable& load) {
  out.values("angles", unit::radian, load.angles);
  out.values("torques", unit::newton_metre, load.torques);
}
void write_parameters(Writer& out, const TableReference& reference) {
  out.values("times", unit::second, reference.table.points());
  out.values("angles", unit::radian, reference.table.values());
}
template <class Parameters>
void write_parameters(Writer& out, const Parameters& parameters) {
  out.fields(parameters);
}

template <class Kind>
void write_kind(Writer& out, const std::string& header, const Kind& kind) {
  out.table(header);
  out.text("kind", std::string(Kind::kind));
  write_parameters(out, kind);
}

/// Every term of a sum as a table of its own.
template <class Sum>
void write_terms(Writer& out, const std::string& path, const Sum& sum) {
  for (const auto& term : sum.terms)
    std::visit([&](const auto& t) { write_kind(out, fmt::format("[[{}]]", path), t); }, term);
}

template <class Load>
void write_load(Writer& out, const Load& load) {
  if constexpr (requires { load.terms; })
    write_terms(out, "load", load);
  else
    write_kind(out, "[load]", load);
}

void write_control(Writer& out, const ControlScenario& control) {
  out.table("[controller]");
  std::visit(
      [&](const auto& law) {
        out.text("kind", std::string(law.kind));
        out.fields(control.sampling);
        if (winds_up(control.law)) {
          out.text("anti_windup",
                   std::string(anti_windup_methods[static_cast<std::size_t>(control.anti_windup.method)]));
          out.fields(control.anti_windup);
        }
        if constexpr (requires { law.fields(); })
          out.fields(law);
        else
          write_terms(out, "controller.torque", law.torque);
      },
      control.law);
  out.table("[controller.nominal]");
  out.fields(control.nominal);
  out.table("[controller.variation]");
  out.fields(control.variations);
  write_terms(out, "reference", control.reference);
  out.table("[sensor]");
  out.text("shaft", control.sensor.on_worm ? "worm" : "gear");
  out.text("speed", control.sensor.exact_speed ? "exact" : "difference");
  out.fields(control.sensor);
  out.table("[disturbance]");
  out.fields(control.disturbance);
  out.table("[metrics]");
  out.fields(control.window);
}

}  // namespace

std::string to_toml(const Scenario& scenario) {
  Writer out(scenario.axis);
  out.text("title", scenario.title);
  out.table("[mesh]");
  const bool worm = std::holds_alternative<MeshParameters<double>>(scenario.mesh);
  out.text("kind", worm ? "worm" : "none");
  if (!worm) out.text("axis", scenario.axis == Axis::linear ? "linear" : "rotary");
  std::visit([&](const auto& parameters) { out.fields(parameters); }, scenario.mesh);
  write_terms(out, "motor.torque", scenario.motor);
  std::visit([&](const auto& load) { write_load(out, load); }, scenario.load);
  scenario.effects.for_each([&](const auto& effect) {
    if (!effect) return;
    out.table(fmt::format("[effect.{}]", effect->id));
    out.fields(*effect);
  });
  out.table("[initial]");
  out.fields(scenario.initial);
  if (scenario.run.duration > 0.0) {  // else it was stated for statics or a diagnosis, without a [run]
    out.table("[run]");
    out.text("solver", scenario.run.solver == SolverKind::taylor ? "taylor" : "cvode");
    out.text("method", scenario.run.method == Method::adams ? "adams" : "bdf");
    out.fields(scenario.run);
  }
  if (scenario.control) write_control(out, *scenario.control);
  if (scenario.tolerance) {
    out.table("[tolerance]");
    out.fields(*scenario.tolerance);
  }
  if (!scenario.columns.empty()) out.table("[data]");
  for (const auto& [usual, called] : scenario.columns) out.text(usual, called);
  return out.take();
}

}  // namespace wormdrive
