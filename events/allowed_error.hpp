#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "core/elastic/impact.hpp"
#include "core/numbers/rounded.hpp"
#include "core/states/effect_states.hpp"
#include "events/integrated_state.hpp"
#include "events/segment_start.hpp"
#include "events/solver_settings.hpp"

namespace wormdrive {

/// What the deflection of elastic teeth [rad] and its rate [rad/s] may err by in a step: the tolerated share of how far
/// the teeth give way or are apart, and of how far they will for their speed, where the rate may change the force by no
/// more than the deflection does; no more than angle and speed of the gear may, and no less than their own rounding.
template <HasElasticTeeth System>
Eigen::Vector2d allowed_deflection(const System& system, const typename System::Instant& now,
                                   const SolverSettings& settings) {
  const auto& mesh = system.mesh();
  const auto at = system.moment(now);
  const auto [d, v] = system.penetration(at, Flank::left);
  const double distance = std::min(std::abs(d), std::abs(system.penetration(at, Flank::right).first));
  const double swing = contact_frequency(system.contact(), effective_mass(mesh, system.rigid().Jg(at)));
  const double give = distance + std::abs(v) / swing;
  const double share = settings.relative_tolerance, least = settings.absolute_tolerance;
  constexpr double told = 2.0 * Rounded::unit;
  const auto integrated = integrated_state(system, now.x);
  double allowed =
      std::min(share * give / mesh.gear_arm(0.0), share * std::abs(now.x[2]) + least) + told * std::abs(integrated[2]);
  if (!(allowed > 0.0)) allowed = least;  // of teeth that just touch, without a gap
  const double delay = std::max(1.0 / swing, system.contact().per_speed(give) / system.contact().stiffness());
  return {allowed, std::min(allowed / delay, share * std::abs(now.x[3]) + least) + told * std::abs(integrated[3])};
}

/// What all that CVODE integrates may err by in a step [units of the state]: its tolerance, and what the rounding of
/// its rate comes to within a step [s] where one is given. No formula follows a motion more closely; a solver that is
/// asked to shortens its steps without end.
template <class System>
typename System::State allowed_error(const System& system, const typename System::Instant& now,
                                     const SolverSettings& settings, double step) {
  typename System::State allowed = settings.relative_tolerance * now.x.cwiseAbs();
  allowed.array() += settings.absolute_tolerance;
  if constexpr (HasElasticTeeth<System>) allowed.template tail<2>() = allowed_deflection(system, now, settings);
  if constexpr (Foresees<System>)
    if (step > 0.0) {
      const auto motion = System::state_at(system.template ahead<4, Rounded>(now));
      typename System::State rounding;
      for (int k = 0; k < System::state_size; ++k) rounding[k] = step * motion[k][1].rounding;
      if constexpr (HasElasticTeeth<System>)
        rounding.template tail<2>() += rounding.template head<2>() / system.mesh().i;
      allowed += rounding;
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

/// Settings for a solver that judges every speed by itself: none may err by more than the rate of the deflection.
template <class System>
SolverSettings for_each_speed(const System& system, const typename System::Instant& now, SolverSettings settings) {
  if constexpr (HasElasticTeeth<System>) {
    const double allowed = allowed_deflection(system, now, settings)[1];
    const double speed = std::max(std::abs(now.x[3]), std::abs(now.x[1]) / system.mesh().i);
    settings.absolute_tolerance = std::min(settings.absolute_tolerance, allowed);
    if (speed > 0.0) settings.relative_tolerance = std::min(settings.relative_tolerance, allowed / speed);
  }
  return settings;
}

}  // namespace wormdrive
