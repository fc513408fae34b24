#pragma once
#include <cmath>
#include <cstddef>
#include <string_view>

#include "core/numbers/rounded.hpp"
#include "core/states/effect_states.hpp"
#include "events/segment_start.hpp"
#include "events/solver_settings.hpp"

namespace wormdrive {

/// What every state may err by in a step [units of the state]: its tolerance, and what the rounding of its rate
/// comes to within a step [s] where one is given. No formula follows a motion more closely; a solver that is asked to
/// shortens its steps without end.
template <class System>
typename System::State allowed_error(const System& system, const typename System::Instant& now,
                                     const SolverSettings& settings, double step) {
  typename System::State allowed = settings.relative_tolerance * now.x.cwiseAbs();
  allowed.array() += settings.absolute_tolerance;
  if constexpr (Foresees<System>)
    if (step > 0.0) {
      const auto motion = System::state_at(system.template ahead<4, Rounded>(now));
      for (int k = 0; k < System::state_size; ++k) allowed[k] += step * motion[k][1].rounding;
    }
  return allowed;
}

/// The weights of errors in the mean square over all states by which CVODE judges a step. A state that there is not, of
/// an effect that is off, errs by nothing, and must not make the others look better than they are.
template <class System>
typename System::State weights_of_errors(const System& system, const typename System::Instant& now,
                                         const SolverSettings& settings, double step) {
  const typename System::State weights = allowed_error(system, now, settings, step).cwiseInverse();
  constexpr int of_shafts = 2 * shaft_count<System>();
  if constexpr (requires { system.effects(); } && System::state_size > of_shafts) {
    int present = of_shafts;
    system.effects().for_each_state([&present](std::string_view, const EffectState&, std::size_t) { ++present; });
    return std::sqrt(double{System::state_size} / present) * weights;
  }
  return weights;
}

/// Whether that is rounding for the greater part, of any state.
template <class System>
bool mostly_rounding(const System& system, const typename System::Instant& now, const SolverSettings& settings,
                     double step) {
  const typename System::State tolerance = allowed_error(system, now, settings, 0.0);
  return (allowed_error(system, now, settings, step).array() > 2.0 * tolerance.array()).any();
}

}  // namespace wormdrive
