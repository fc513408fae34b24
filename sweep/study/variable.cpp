#include "sweep/study/variable.hpp"

#include <fmt/format.h>

#include "description/tables.hpp"

namespace wormdrive {
namespace {

template <class Parameters>
void collect(const std::string& path, Parameters& parameters, Axis axis, std::vector<Variable>& list) {
  for_each_field<Parameters>([&](const auto& field) {
    for (Spelling& spelling : spellings(field.name, field.unit, axis)) {
      spelling.key = fmt::format("{}.{}", path, spelling.key);
      const std::string name = fmt::format("{}.{}", path, spelling.stem);
      list.push_back({name, std::move(spelling), field.bounds, &(parameters.*field.member)});
    }
  });
}

}  // namespace

std::vector<Variable> variables(Scenario& scenario) {
  std::vector<Variable> list;
  for_each_table(scenario, [&]<class Parameters>(const TablePlace& place, Parameters& parameters) {
    if constexpr (has_numbers_of_drive<Parameters>) {
      collect(place.path(), parameters, scenario.axis, list);
      if (place.term && place.of == 1) collect(place.indexed(), parameters, scenario.axis, list);
    }
  });
  return list;
}

}  // namespace wormdrive
