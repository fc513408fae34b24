#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "description/scenario.hpp"

namespace wormdrive {

/// Where a table of a scenario stands: the k-th of several that add up, or the only one of its header.
struct TablePlace {
  std::string header;  ///< "effect.stribeck", "load"
  std::size_t k = 0, of = 1;
  bool term = false;  ///< of a sum: there could be several

  /// "load", or "load[1]" where there are several, the first of them `first`.
  std::string path(std::size_t first = 0) const { return of == 1 ? header : indexed(first); }
  std::string indexed(std::size_t first = 0) const { return fmt::format("{}[{}]", header, k + first); }
};

/// Whether a table holds single numbers that say what a drive is or how it is controlled, not how it is simulated or
/// measured.
template <class Parameters>
inline constexpr bool has_numbers_of_drive =
    !std::is_same_v<Parameters, RunSettings> && !std::is_same_v<Parameters, Tolerances> &&
    !std::is_same_v<Parameters, ExperimentLimits> && !std::is_same_v<Parameters, MetricsWindow> && requires {
  Parameters::fields();
};

/// Calls visit(place, parameters) for every parameter struct that a scenario states, in the order of the file that
/// to_toml() writes. A controller's law, sampling and anti-windup share one header. Structs without fields() are
/// functions that points state, or a law whose torques follow.
template <class ScenarioRef, class Visit>
void for_each_table(ScenarioRef& scenario, Visit&& visit) {
  const auto plain = [&](std::string header, auto& parameters) { visit(TablePlace{std::move(header)}, parameters); };
  const auto terms = [&](const std::string& header, auto& list) {
    for (std::size_t k = 0; k < list.size(); ++k)
      std::visit([&](auto& term) { visit(TablePlace{header, k, list.size(), true}, term); }, list[k]);
  };
  std::visit([&](auto& mesh) { plain("mesh", mesh); }, scenario.mesh);
  terms("motor.torque", scenario.motor.terms);
  std::visit(
      [&](auto& load) {
        if constexpr (requires { load.terms; })
          terms("load", load.terms);
        else
          visit(TablePlace{"load", 0, 1, true}, load);
      },
      scenario.load);
  scenario.effects.for_each([&](auto& effect) {
    if (effect) plain(fmt::format("effect.{}", effect->id), *effect);
  });
  plain("initial", scenario.initial);
  if (scenario.run.duration > 0.0)
    plain("run", scenario.run);  // else it is for statics or a diagnosis, without a [run]
  if (scenario.control) {
    auto& control = *scenario.control;
    std::visit([&](auto& law) { plain("controller", law); }, control.law);
    plain("controller", control.sampling);
    if (winds_up(control.law)) plain("controller", control.anti_windup);
    if (auto* const held = std::get_if<OpenLoopParameters>(&control.law))
      terms("controller.torque", held->torque.terms);
    plain("controller.nominal", control.nominal);
    plain("controller.variation", control.variations);
    terms("reference", control.reference.terms);
    plain("sensor", control.sensor);
    plain("disturbance", control.disturbance);
    plain("metrics", control.window);
  }
  if (scenario.tolerance) plain("tolerance", *scenario.tolerance);
  if (scenario.limits) plain("limits", *scenario.limits);
}

}  // namespace wormdrive
