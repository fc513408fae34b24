#pragma once
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <nlohmann/json.hpp>

#include "bindings/fmi/plant_parameters.hpp"
#include "description/variant_kinds.hpp"

namespace wormdrive {

using Json = nlohmann::json;

/// One description of the file for both directions: it puts what it is given into the JSON, or takes it from there.
struct Writer {
  static constexpr bool reads = false;
  Axis axis;
  void operator()(Json& at, std::string_view key, const double& value) const {
    if (std::isfinite(value)) at[std::string(key)] = value;  // an infinite default is stated by absence
  }
  void operator()(Json& at, std::string_view key, const std::optional<double>& value) const {
    if (value) at[std::string(key)] = *value;
  }
  void operator()(Json& at, std::string_view key, const std::vector<double>& values) const {
    at[std::string(key)] = values;
  }
};
struct Reader {
  static constexpr bool reads = true;
  Axis axis;
  void operator()(Json& at, std::string_view key, double& value) const {
    if (const auto found = at.find(key); found != at.end()) value = found->get<double>();
  }
  void operator()(Json& at, std::string_view key, std::optional<double>& value) const {
    if (const auto found = at.find(key); found != at.end()) value = found->get<double>();
  }
  void operator()(Json& at, std::string_view key, std::vector<double>& values) const { at.at(key).get_to(values); }
};

template <class Direction, class Parameters>
void transfer(const Direction& pass, Json& at, Parameters& parameters) {
  using P = std::remove_const_t<Parameters>;
  for_each_choice<P>([&](const auto& one) {
    if constexpr (Direction::reads)
      one.set(parameters, at.at(one.key).template get<std::string>());
    else
      at[std::string(one.key)] = one.word(parameters);
  });
  if constexpr (requires { P::fields(); }) {
    for_each_field<P>([&](const auto& field) {
      pass(at, si_spelling(field.name, field.unit, pass.axis).key, parameters.*field.member);
    });
  } else if constexpr (requires { parameters.times; }) {
    pass(at, "times", parameters.times);
    pass(at, "values", parameters.values);
  }
  if constexpr (requires { parameters.columns(); }) {
    std::vector<double> points = parameters.table.points(), values = parameters.table.values();
    pass(at, "points", points);
    pass(at, "values", values);
    if constexpr (Direction::reads) parameters.table = CubicTable(std::move(points), std::move(values));
  }
}

/// One of several kinds, with its name.
template <class Kind>
Json kind_to_json(const Kind& parameters, Axis axis) {
  Json at{{"kind", std::string(Kind::kind)}};
  transfer(Writer{axis}, at, parameters);
  return at;
}

/// A sum of terms, each of one of several kinds.
template <class Terms>
Json terms_to_json(const Terms& terms, Axis axis) {
  Json list = Json::array();
  for (const auto& term : terms) list.push_back(std::visit([&](const auto& t) { return kind_to_json(t, axis); }, term));
  return list;
}
template <class Term>
std::vector<Term> terms_from_json(Json& list, Axis axis) {
  std::vector<Term> terms;
  for (Json& one : list) {
    Term term = make_kind<Term>(one.at("kind").get<std::string>());
    std::visit([&](auto& parameters) { transfer(Reader{axis}, one, parameters); }, term);
    terms.push_back(std::move(term));
  }
  return terms;
}

}  // namespace wormdrive
