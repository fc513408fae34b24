#include "description/toml/write_scenario.hpp"

#include <cmath>
#include <locale>
#include <sstream>
#include <type_traits>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "description/keys.hpp"
#include "description/number_text.hpp"
#include "description/tables.hpp"

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

  /// Begins a table, unless it is that of the last call.
  void table(const TablePlace& place) {
    if (place.of == 1 && place.header == header_) return;
    header_ = place.header;
    text_ += place.of == 1 ? fmt::format("\n[{}]\n", header_) : fmt::format("\n[[{}]]\n", header_);
  }
  void text(const std::string& key, const std::string& value) {
    std::ostringstream quoted;  // toml++ knows how to quote
    quoted.imbue(std::locale::classic());
    quoted << toml::node_view<const toml::node>(toml::value<std::string>(value));
    text_ += fmt::format("{} = {}\n", key, quoted.str());
  }
  template <class Parameters>
  void fields(const Parameters& parameters) {
    choices(parameters);
    for_each_field<Parameters>([&](const auto& field) { value(field.name, field.unit, parameters.*field.member); });
  }
  template <class Parameters>
  void choices(const Parameters& parameters) {
    for_each_choice<Parameters>(
        [&](const auto& one) { text(std::string(one.key), std::string(one.word(parameters))); });
  }
  void value(std::string_view name, const Unit& unit, const std::optional<double>& si) {
    if (!si || !std::isfinite(*si)) return;  // an infinite default is stated by absence
    const Statement s = exactly(*si, spellings(name, unit, axis_));
    text_ += fmt::format("{} = {}\n", s.key, s.number);
  }
  void values(std::string_view name, const Unit& unit, const std::vector<double>& si) {
    text_ += fmt::format("{} = [", si_spelling(name, unit, axis_).key);
    for (std::size_t k = 0; k < si.size(); ++k) text_ += fmt::format("{}{}", k == 0 ? "" : ", ", number(si[k]));
    text_ += "]\n";
  }
  std::string take() { return std::move(text_); }

 private:
  Axis axis_;
  std::string text_, header_;
};

void write_parameters(Writer& out, const Samples& samples) {
  out.choices(samples);
  out.values("times", unit::second, samples.times);
  out.values("torques", unit::newton_metre, samples.values);
}
void write_parameters(Writer&, const OpenLoopParameters&) {}  // whose torques are tables of their own
template <class Parameters>
void write_parameters(Writer& out, const Parameters& parameters) {
  if constexpr (requires { Parameters::fields(); }) out.fields(parameters);
  if constexpr (requires { parameters.columns(); }) {
    const TableColumns columns = parameters.columns();
    out.values(columns.points.stem, columns.points.unit, parameters.table.points());
    out.values(columns.values.stem, columns.values.unit, parameters.table.values());
  }
}

}  // namespace

std::string to_toml(const Scenario& scenario) {
  Writer out(scenario.axis);
  out.text("title", scenario.title);
  for_each_table(scenario, [&]<class Parameters>(const TablePlace& place, const Parameters& parameters) {
    out.table(place);
    if constexpr (std::is_same_v<Parameters, MeshParameters<double>>) out.text("kind", "worm");
    if constexpr (std::is_same_v<Parameters, SingleInertia<double>>) {
      out.text("kind", "none");
      out.text("axis", scenario.axis == Axis::linear ? "linear" : "rotary");
    }
    if constexpr (requires { Parameters::kind; }) out.text("kind", std::string(Parameters::kind));
    write_parameters(out, parameters);
  });
  if (!scenario.columns.empty()) out.table({"data"});
  for (const auto& [usual, called] : scenario.columns) out.text(usual, called);
  return out.take();
}

}  // namespace wormdrive
