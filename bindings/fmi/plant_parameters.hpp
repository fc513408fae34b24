#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include <fmt/format.h>

#include "description/keys.hpp"
#include "description/scenario.hpp"

namespace wormdrive {

/// Calls visit(path, parameters) for every parameter struct of what moves a drive by samples.
template <class ControlRef, class Visit>
void for_each_control_table(ControlRef& control, Visit&& visit) {
  visit(std::string("controller"), control.sampling);
  visit(std::string("controller"), control.anti_windup);
  std::visit([&](auto& law) { visit(std::string("controller"), law); }, control.law);
  visit(std::string("controller.nominal"), control.nominal);
  visit(std::string("controller.variation"), control.variations);
  int k = 0;
  for (auto& term : control.reference.terms) {
    const std::string path = control.reference.terms.size() == 1 ? "reference" : fmt::format("reference[{}]", ++k);
    std::visit([&](auto& parameters) { visit(path, parameters); }, term);
  }
  visit(std::string("sensor"), control.sensor);
  visit(std::string("disturbance"), control.disturbance);
}

/// Calls visit(path, parameters) for every parameter struct of what an FMU carries: mesh, load, effects that are on,
/// initial state; then what is left of motor torque and controller, which a plant has not.
template <class ScenarioRef, class Visit>
void for_each_plant_table(ScenarioRef& scenario, Visit&& visit) {
  std::visit([&](auto& mesh) { visit(std::string("mesh"), mesh); }, scenario.mesh);
  std::visit(
      [&]<class Load>(Load& load) {
        if constexpr (requires { load.terms; }) {
          int k = 0;
          for (auto& term : load.terms) {
            const std::string path = load.terms.size() == 1 ? "load" : fmt::format("load[{}]", ++k);
            std::visit([&](auto& parameters) { visit(path, parameters); }, term);
          }
        } else {
          visit(std::string("load"), load);
        }
      },
      scenario.load);
  scenario.effects.for_each([&](auto& effect) {
    if (effect) visit(fmt::format("effect.{}", effect->id), *effect);
  });
  visit(std::string("initial"), scenario.initial);
  int k = 0;
  for (auto& term : scenario.motor.terms) {
    const std::string path = scenario.motor.terms.size() == 1 ? "motor.torque" : fmt::format("motor.torque[{}]", ++k);
    std::visit([&](auto& parameters) { visit(path, parameters); }, term);
  }
  if (scenario.control) for_each_control_table(*scenario.control, visit);
}

/// Calls visit(path, field, value) for every number of the plant that is stated, in one order: its k-th has the k-th
/// value reference among the parameters. Tables over time or angle are no parameters.
template <class ScenarioRef, class Visit>
void for_each_plant_parameter(ScenarioRef& scenario, Visit&& visit) {
  for_each_plant_table(scenario, [&]<class P>(const std::string& path, P& parameters) {
    using Parameters = std::remove_const_t<P>;
    if constexpr (requires { Parameters::fields(); })
      for_each_field<Parameters>([&](const auto& field) {
        auto& value = parameters.*field.member;
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, double>) {
          if (std::isfinite(value)) visit(path, field, value);
        } else if (value) {
          visit(path, field, *value);
        }
      });
  });
}

/// Whether the numbers of a field are whole, which its bounds do not say.
template <class Field>
bool is_whole(const Field& field) {
  return field.name == "seed" || field.name == "counts" || field.name == "count" || field.name == "delay_samples";
}

/// How a number in SI is written in a scenario: the key that an FMU takes over.
template <class Field>
Spelling si_spelling(const Field& field, Axis axis) {
  const std::vector<Spelling> all = spellings(field.name, field.unit, axis);
  return *std::find_if(all.begin(), all.end(), [](const Spelling& s) { return s.unit.si == 1.0; });
}

}  // namespace wormdrive
