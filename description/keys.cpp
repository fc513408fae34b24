#include "description/keys.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace wormdrive {
namespace {

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// The linear counterpart of a rotary quantity; what is not rotary stays.
Spelling linear(std::string_view name, const Unit& unit) {
  std::string stem = replaced(replaced(std::string(name), "torque", "force"), "inertia", "mass");
  const bool angle = unit.suffix == "rad" || (unit.suffix == "deg" && name.starts_with("angle"));  // a phase is none
  if (angle || unit.suffix == "rad_per_s") stem = replaced(replaced(stem, "gear_", ""), "angle", "position");
  if (unit.suffix == "Nm") return {stem, {"N", "N"}};
  if (angle) return {stem, {"m", "m"}};
  if (unit.suffix == "rad_per_s") return {stem, {"m_per_s", "m/s"}};
  if (unit.suffix == "kgm2") return {stem, {"kg", "kg"}};
  if (unit.suffix == "Nm_per_s") return {stem, {"N_per_s", "N/s"}};
  if (unit.suffix == "Nm_per_rad") return {stem, {"N_per_m", "N/m"}};
  if (unit.suffix == "Nms_per_rad") return {stem, {"Ns_per_m", "N s/m"}};
  if (unit.suffix == "s_per_rad") return {stem, unit::second_per_metre};
  if (unit.suffix == "Nm_per_A") return {stem, {"N_per_A", "N/A"}};
  if (unit.suffix == "V_per_Nm") return {stem, {"V_per_N", "V/N"}};
  return {stem, unit};
}

Spelling with_suffix(Spelling s) {
  s.stem = s.key;
  if (!s.unit.suffix.empty()) s.key += fmt::format("_{}", s.unit.suffix);
  return s;
}

/// Levenshtein distance.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t above = row[j + 1];
      row[j + 1] = std::min({above + 1, row[j] + 1, diagonal + (a[i] == b[j] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row.back();
}

}  // namespace

std::vector<Spelling> spellings(std::string_view name, const Unit& unit, Axis axis) {
  std::vector<Spelling> list{axis == Axis::linear ? linear(name, unit) : Spelling{std::string(name), unit}};
  const std::string stem = list.front().key;
  if (list.front().unit.suffix == "deg") list.push_back({stem, unit::radian});
  if (list.front().unit.suffix == "rad") list.push_back({stem, unit::degrees});
  if (list.front().unit.suffix == "percent") list.push_back({stem, unit::share});
  std::transform(list.begin(), list.end(), list.begin(), with_suffix);
  return list;
}

Spelling si_spelling(std::string_view name, const Unit& unit, Axis axis) {
  const std::vector<Spelling> all = spellings(name, unit, axis);
  return *std::find_if(all.begin(), all.end(), [](const Spelling& s) { return s.unit.si == 1.0; });
}

std::string in_words_of(Axis axis, std::string_view meaning) {
  std::string words(meaning);
  if (axis == Axis::linear)
    for (const auto& [rotary, straight] : {std::pair{"torque", "force"},
                                           {"inertia", "mass"},
                                           {"gear angle", "position"},
                                           {"gear speed", "speed"},
                                           {"worm speed", "speed"},
                                           {"rad/s", "m/s"},
                                           {"rad ", "m "}})
      words = replaced(words, rotary, straight);
  return words;
}

std::optional<std::string> probably_meant(std::string_view unknown, const std::vector<std::string>& valid) {
  if (valid.empty()) return std::nullopt;
  const auto score = [&](const std::string& key) {
    // A forgotten or wrong unit is the commonest slip.
    const bool same_stem = key.starts_with(unknown) || unknown.starts_with(key.substr(0, key.rfind('_')));
    return same_stem ? std::min<std::size_t>(1, distance(unknown, key)) : distance(unknown, key);
  };
  const auto nearest = std::min_element(valid.begin(), valid.end(), [&](const auto& a, const auto& b) {
    return std::pair(score(a), distance(unknown, a)) < std::pair(score(b), distance(unknown, b));
  });
  if (score(*nearest) > std::max<std::size_t>(2, unknown.size() / 3)) return std::nullopt;
  return *nearest;
}

std::string suggestion(std::string_view unknown, const std::vector<std::string>& valid) {
  if (valid.empty()) return "no keys are allowed here";
  if (const auto meant = probably_meant(unknown, valid)) return fmt::format("did you mean '{}'?", *meant);
  return fmt::format("valid keys: {}", fmt::join(valid, ", "));
}

}  // namespace wormdrive
