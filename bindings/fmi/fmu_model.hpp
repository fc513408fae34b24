#pragma once
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "core/elastic/elastic_teeth.hpp"
#include "description/scenario.hpp"

namespace wormdrive {

/// What of a scenario an FMU carries.
enum class FmuKind {
  plant,  ///< mesh, load, effects and initial state; the motor torque is the input
  loop,   ///< everything: the motor's torque or the controller with its reference and sensor, too
};

/// How an importer runs an FMU [FMI 2.0.4 and 3.0, section 1].
enum class InterfaceType {
  model_exchange,  ///< the importer integrates
  co_simulation,   ///< the FMU integrates from one communication point to the next
};

/// What an FMU is made of: the part of a scenario that it carries.
struct FmuModel {
  FmuKind kind = FmuKind::plant;
  Scenario scenario;
  std::string token{};  ///< GUID or instantiation token, where it is known
};

/// What messages are about, for importers that choose among them.
inline constexpr std::array<std::string_view, 2> log_categories{"logStatusDiscard", "logStatusError"};

/// Whether CVODE, which elastic teeth need, is part of the library of FMUs: not of that for Windows, nor where there is
/// no static library of it.
#ifdef WORMDRIVE_FMU_CVODE
inline constexpr bool elastic_teeth_inside = true;
#else
inline constexpr bool elastic_teeth_inside = false;
#endif

/// The interface types that an FMU has.
struct Offered {
  bool model_exchange, co_simulation;
};
/// An importer's solver knows neither the past, which delays and lags need, nor samples.
inline Offered offered(const FmuModel& model) {
  const Effects<double>& on = model.scenario.effects;
  const bool past = on.delay() > 0.0 || on.lag() > 0.0 || on.measuring_delay() > 0.0;
  return {model.kind == FmuKind::plant && !past, elastic_teeth_inside || !has_elastic_teeth(on)};
}
/// Whether the library for Windows has a solver for what the FMU offers, at least an importer's.
inline bool runs_under_windows(const FmuModel& model) {
  return !has_elastic_teeth(model.scenario.effects) || offered(model).model_exchange;
}

/// What of a model's inputs follows from more than its present numbers: a lag of a torque over time.
inline bool can_be_serialized(const FmuModel& model) {
  return model.scenario.effects.lag() <= 0.0 || model.scenario.motor.terms.empty();
}

/// The part of a scenario that an FMU of this kind carries.
inline FmuModel carried(Scenario scenario, FmuKind kind) {
  if (kind == FmuKind::plant) {
    scenario.motor = {};
    scenario.control.reset();
  }
  return {kind, std::move(scenario), {}};
}

}  // namespace wormdrive
