#include "bindings/fmi/plant_parameters.hpp"

#include <cmath>
#include <type_traits>

#include "description/tables.hpp"

namespace wormdrive {

namespace {

template <class Value, class ScenarioRef>
std::vector<PlantParameter<Value>> list(ScenarioRef& scenario) {
  std::vector<PlantParameter<Value>> all;
  for_each_table(scenario, [&]<class P>(const TablePlace& place, P& table) {
    using Parameters = std::remove_const_t<P>;
    if constexpr (has_numbers_of_drive<Parameters>) {
      const std::string path = place.path(1) + ".";
      const auto add = [&](std::string_view name, const Unit& unit, const Bounds& bounds, std::string_view meaning,
                           Value& value) {
        Spelling s = si_spelling(name, unit, scenario.axis);
        s.unit.whole = unit.whole;
        all.push_back({path + s.key, s.unit, bounds, meaning, &value});
      };
      for_each_field<Parameters>([&](const auto& field) {
        auto& value = table.*field.member;
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, double>) {
          if (std::isfinite(value)) add(field.name, field.unit, field.bounds, field.meaning, value);
        } else if (value) {
          add(field.name, field.unit, field.bounds, field.meaning, *value);
        }
      });
    }
  });
  return all;
}

}  // namespace

template <class Value>
bool PlantParameter<Value>::is_allowed(double x) const {
  return std::isfinite(x) && bounds.contain(x) && (!unit.whole || x == std::floor(x));
}
template struct PlantParameter<double>;
template struct PlantParameter<const double>;

std::vector<PlantParameter<double>> plant_parameters(Scenario& scenario) { return list<double>(scenario); }
std::vector<PlantParameter<const double>> plant_parameters(const Scenario& scenario) {
  return list<const double>(scenario);
}

}  // namespace wormdrive
