#include "diagnosis/report/uncertainty_study.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "description/keys.hpp"
#include "diagnosis/candidates/coordinates.hpp"

namespace wormdrive {

namespace {

/// A field of an effect as a study names it, and the unit of its numbers.
struct ParameterPath {
  std::string text;
  double unit;
};

ParameterPath path_of(std::string_view effect, std::string_view field, const Unit& unit, Axis axis) {
  const Spelling s = spellings(field, unit, axis).front();
  return {fmt::format("effect.{}.{}", effect, s.key), s.unit.si};
}

/// What the effects with uncertain numbers state beside them, as --set takes it.
std::vector<std::string> certain_fields(const Diagnosis& d) {
  const JointEstimate& u = d.uncertainty;
  std::vector<std::string> list;
  d.extended.effects.for_each([&]<class E>(const std::optional<E>& effect) {
    if (!effect || std::find(u.effects.begin(), u.effects.end(), E::id) == u.effects.end()) return;
    for_each_field<E>([&](const auto& field) {
      for (std::size_t k = 0; k < u.numbers.size(); ++k)
        if (u.effects[k] == E::id && u.numbers[k].field == field.name) return;
      const std::optional<double> value = (*effect).*field.member;
      if (!value || !std::isfinite(*value)) return;
      const ParameterPath path = path_of(E::id, field.name, field.unit, d.extended.axis);
      list.push_back(fmt::format("\"{}={}\"", path.text, *value / path.unit));
    });
  });
  return list;
}

/// Without the faults of a recording, which no drive has.
JointEstimate of_drive(const JointEstimate& all) {
  JointEstimate u;
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < all.numbers.size(); ++k)
    if (!is_recording_fault(all.effects[k])) kept.push_back(k);
  for (const std::size_t a : kept) {
    u.effects.push_back(all.effects[a]);
    u.numbers.push_back(all.numbers[a]);
    u.correlation.emplace_back();
    for (const std::size_t b : kept) u.correlation.back().push_back(all.correlation[a][b]);
  }
  for (const std::vector<double>& draw : all.draws) {
    u.draws.emplace_back();
    for (const std::size_t a : kept) u.draws.back().push_back(draw[a]);
  }
  return u;
}

std::vector<ParameterPath> paths_of(const JointEstimate& u, Axis axis) {
  std::vector<ParameterPath> paths;
  for (std::size_t k = 0; k < u.numbers.size(); ++k) {
    const std::string& field = u.numbers[k].field;
    paths.push_back(path_of(u.effects[k], field, field_of({}, u.effects[k], field).unit, axis));
  }
  return paths;
}

/// Normal, cut off where a draw would lie beyond what the number may be.
std::string normal_parameter(const ParameterPath& path, const std::string& effect, const Estimate& e) {
  const Bounds& bounds = field_of({}, effect, e.field).bounds;
  constexpr double far = 6.0;  // deviations beyond which no draw lies
  const bool low = e.value - far * e.standard_error<bounds.low, high = e.value + far * e.standard_error> bounds.high;
  std::string text =
      fmt::format("\n[[parameter]]\npath = \"{}\"\ndistribution = \"{}\"\nmean = {}\ndeviation = {}\n", path.text,
                  low || high ? "truncated_normal" : "normal", e.value / path.unit, e.standard_error / path.unit);
  if (low) text += fmt::format("low = {}\n", bounds.low / path.unit);
  if (high) text += fmt::format("high = {}\n", bounds.high / path.unit);
  return text;
}

std::string correlations(const JointEstimate& u, const std::vector<ParameterPath>& paths) {
  std::string text;
  for (std::size_t a = 0; a < paths.size(); ++a)
    for (std::size_t b = a + 1; b < paths.size(); ++b) {
      constexpr double least = 1e-4, most = 1.0 - 1e-9;
      const double correlation = std::clamp(u.correlation[a][b], -most, most);
      if (std::abs(correlation) < least) continue;
      text += fmt::format("\n[[correlation]]\nbetween = [\"{}\", \"{}\"]\ncoefficient = {}\n", paths[a].text,
                          paths[b].text, correlation);
    }
  return text;
}

}  // namespace

std::string uncertainty_study(const Diagnosis& d) {
  const JointEstimate u = of_drive(d.uncertainty);
  if (u.numbers.empty()) return "";
  std::string text =
      "# The joint distribution that the data of a diagnosis leave for the numbers that they determine. To learn what "
      "it\n"
      "# means for another motion or a controller, name another scenario of the same drive here.\n"
      "title = \"What the data leave open\"\n"
      "scenario = \"extended.toml\"\n";
  if (const std::vector<std::string> certain = certain_fields(d); !certain.empty())
    text += fmt::format("set = [{}]\n", fmt::join(certain, ", "));
  const std::vector<ParameterPath> paths = paths_of(u, d.extended.axis);
  text += fmt::format("\n[sweep]\ndesign = \"latin_hypercube\"\ntrials = {}\nseed = 1\n",
                      u.draws.empty() ? 1000 : u.draws.size());
  for (std::size_t k = 0; k < paths.size(); ++k)
    text += u.draws.empty() ? normal_parameter(paths[k], u.effects[k], u.numbers[k])
                            : fmt::format("\n[[parameter]]\npath = \"{}\"\ndistribution = \"row\"\nfile = \"{}\"\n",
                                          paths[k].text, draws_file);
  return u.draws.empty() ? text + correlations(u, paths) : text;
}

std::string uncertainty_draws(const Diagnosis& d) {
  const JointEstimate u = of_drive(d.uncertainty);
  if (u.draws.empty() || u.numbers.empty()) return "";
  const std::vector<ParameterPath> paths = paths_of(u, d.extended.axis);
  std::string text;
  for (std::size_t k = 0; k < paths.size(); ++k) text += (k == 0 ? "" : ",") + paths[k].text;
  for (const std::vector<double>& draw : u.draws)
    for (std::size_t k = 0; k < paths.size(); ++k)
      text += fmt::format("{}{}", k == 0 ? "\n" : ",", draw[k] / paths[k].unit);
  return text + "\n";
}

}  // namespace wormdrive
