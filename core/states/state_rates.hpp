#pragma once
#include <algorithm>
#include <array>
#include <optional>
#include <type_traits>

#include "core/effects.hpp"
#include "core/mesh.hpp"

namespace wormdrive {

/// Torque of a load behind a coupling, in the direction of its own speed [N m].
template <class T, class S, class Load>
S torque_behind(const Effects<T>& effects, const Load& load, const Moment<S>& there) {
  const S speed = there.omega_g;
  const Motion motion = is_positive(speed)       ? Motion::forward
                        : is_positive(S(-speed)) ? Motion::backward
                                                 : Motion::stuck;
  return effects.torque_of(load, there, motion);
}

/// Rates of the states of a coupling that twists.
template <class T, class S, class Load>
std::array<S, 2> behind_coupling(const Effects<T>& effects, const LoadCoupling<T>& coupling, const Load& load,
                                 const Moment<S>& at, const std::array<S, 2>& states) {
  const Moment<S> there = coupling.at_load(at, states);
  const S tau_l = torque_behind(effects, load, there);
  if (!effects.inertia_varies()) return coupling.state_rates(tau_l, S(T(load.inertia())), at, states);
  const VaryingInertia<S> J = effects.inertia_at(there.theta_g);
  return coupling.state_rates(S(tau_l - T(0.5) * J.slope * (there.omega_g * there.omega_g)),
                              S(T(load.inertia()) + J.inertia), at, states);
}

/// Rates of the states of effects, for a command [N m], a mesh and a load; friction_loss() is the power that friction
/// takes [W].
template <class T, class S, class Load, class Loss>
std::array<S, effect_state_count> state_rates(const Effects<T>& effects, const S& command, const GearMesh<T>& mesh,
                                              const Load& load, const MomentOfEffects<S>& at, Motion motion,
                                              Loss&& friction_loss) {
  using EffectStates = StateLayout<EffectList<T>>;
  std::array<S, effect_state_count> rates{};
  effects.for_each([&]<class E>(const std::optional<E>& effect) {
    if constexpr (MayHaveStates<E>) {
      if (!effect || !has_states(*effect)) return;
      const auto states = EffectStates::template of<E>(at.states);
      const auto own = [&] {
        if constexpr (std::is_same_v<E, LoadCoupling<T>>)
          return behind_coupling<T, S>(effects, *effect, load, at, states);
        else if constexpr (std::is_same_v<E, MeshLuGre<T>>) {
          const SlidingContact<S> teeth{at, motion, mesh.sliding_speed(at.omega_w)};
          return effect->state_rates(effects.template friction<true>(S(mesh.mu), teeth, at), teeth, states);
        } else if constexpr (requires { effect->state_rates(command, states); })
          return effect->state_rates(friction_loss(), states);
        else
          return effect->state_rates(command, at, motion, states);
      }();
      std::copy(own.begin(), own.end(), rates.begin() + EffectStates::template first<E>());
    }
  });
  return rates;
}

/// The states of effects with which a run starts at a moment, under a load: 0, unless an effect states another one, or
/// is a coupling that carries it.
template <class T, class Load>
std::array<T, effect_state_count> starting_states(const Effects<T>& effects, const Load& load, const Moment<T>& at) {
  using EffectStates = StateLayout<EffectList<T>>;
  std::array<T, effect_state_count> all;
  all.fill(T(0.0));
  effects.for_each([&]<class E>(const std::optional<E>& effect) {
    if constexpr (requires { effect->starting_states(); })
      if (effect) std::ranges::copy(effect->starting_states(), all.begin() + EffectStates::template first<E>());
  });
  if (const auto* const coupling = effects.twisting_coupling()) {
    const auto own = coupling->start(
        at,
        [&]<class S>(const S& twist) {
          const Moment<S> gear{S(at.t), S(at.theta_g), S(at.omega_g), S(at.omega_w), S(at.theta_w)};
          return torque_behind(effects, load, coupling->at_load(gear, std::array{twist, gear.omega_g}));
        },
        load.ripple());
    std::copy(own.begin(), own.end(), all.begin() + EffectStates::template first<LoadCoupling<T>>());
  }
  return all;
}

/// Speed of what turns with the load [rad/s], in a state that begins with angle and speed of the gear.
template <class T, class State>
T load_speed(const Effects<T>& effects, const State& x) {
  return effects.twisting_coupling() ? x[2 + StateLayout<EffectList<T>>::template first<LoadCoupling<T>>() + 1] : x[1];
}

}  // namespace wormdrive
