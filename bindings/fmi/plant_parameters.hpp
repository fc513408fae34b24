#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "description/keys.hpp"
#include "description/tables.hpp"

namespace wormdrive {

/// Calls visit(path, field, value) for every number that is stated of what an FMU carries, in one order: its k-th has
/// the k-th value reference among the parameters. Tables over time or angle are no parameters. Terms of a sum are
/// counted from 1, as arrays of FMI are.
template <class ScenarioRef, class Visit>
void for_each_plant_parameter(ScenarioRef& scenario, Visit&& visit) {
  for_each_table(scenario, [&]<class P>(const TablePlace& place, P& parameters) {
    using Parameters = std::remove_const_t<P>;
    if constexpr (has_numbers_of_drive<Parameters>) {
      const std::string path = place.path(1);
      for_each_field<Parameters>([&](const auto& field) {
        auto& value = parameters.*field.member;
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, double>) {
          if (std::isfinite(value)) visit(path, field, value);
        } else if (value) {
          visit(path, field, *value);
        }
      });
    }
  });
}

/// How a number in SI is written in a scenario: the key that an FMU takes over.
template <class Field>
Spelling si_spelling(const Field& field, Axis axis) {
  const std::vector<Spelling> all = spellings(field.name, field.unit, axis);
  return *std::find_if(all.begin(), all.end(), [](const Spelling& s) { return s.unit.si == 1.0; });
}

}  // namespace wormdrive
