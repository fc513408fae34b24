#pragma once
#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "core/effect_list.hpp"
#include "core/hook.hpp"
#include "core/states/effect_states.hpp"

namespace wormdrive {

/// The effects of a drive, asked place by place; an effect answers only where it has a hook.
template <class T>
struct Effects {
  using EffectStates = StateLayout<EffectList<T>>;
  EffectList<T> list;

  /// Calls visit(optional effect) for every effect of the catalogue.
  template <class Visit>
  void for_each(Visit&& visit) {
    for_each_in(list, visit);
  }
  template <class Visit>
  void for_each(Visit&& visit) const {
    for_each_in(list, visit);
  }

  /// Largest magnitude of the motor's command [N m], infinity without a limit.
  T torque_limit() const {
    return through(list, T(std::numeric_limits<double>::infinity()),
                   [](const auto& e, const T& limit) -> decltype(e.torque_limit()) {
                     return e.torque_limit() < limit ? e.torque_limit() : limit;
                   });
  }
  /// Delay of the command on its way to the motor [s].
  T delay() const {
    return through(list, T(0.0),
                   [](const auto& e, const T& sum) -> decltype(sum + e.delay()) { return sum + e.delay(); });
  }
  /// Time constant with which the motor's torque follows [s], 0 for at once.
  T lag() const {
    return through(list, T(0.0), [](const auto& e, const T& sum) -> decltype(sum + e.lag()) { return sum + e.lag(); });
  }
  /// Torque that the motor gives for a command [N m]. M: a moment, with the states of effects or without.
  template <class S, template <class> class M>
  S motor_torque(const S& command, const M<S>& at) const {
    return through(
        list, command,
        []<class E>(const E& e, const S& torque, const auto& now) -> decltype(e.motor_torque(torque, now)) {
          if constexpr (MayHaveStates<E> && requires { now.states; })
            if (has_states(e)) return e.motor_torque(torque, now, EffectStates::template of<E>(now.states));
          return e.motor_torque(torque, now);
        },
        at);
  }
  /// Calls visit(id of its effect, state, its place among all) for every state that there is.
  template <class Visit>
  void for_each_state(Visit&& visit) const {
    for_each([&]<class E>(const std::optional<E>& effect) {
      if constexpr (MayHaveStates<E>)
        for (std::size_t k = 0; effect && k < E::states.size(); ++k)
          if (effect->has_state(k)) visit(E::id, E::states[k], EffectStates::template first<E>() + k);
    });
  }
  bool have_states() const {
    bool any = false;
    for_each_state([&](std::string_view, const EffectState&, std::size_t) { any = true; });
    return any;
  }
  /// Calls visit with every quantity at whose zero what an effect with states does bends, for a command [N m].
  template <class S, class Visit>
  void for_each_bend(const S& command, const MomentOfEffects<S>& at, Visit&& visit) const {
    for_each([&]<class E>(const std::optional<E>& effect) {
      if constexpr (MayHaveStates<E>) {
        const auto own = EffectStates::template of<E>(at.states);
        if constexpr (requires { effect->for_each_bend(command, at, own, visit); })
          if (effect) effect->for_each_bend(command, at, own, visit);
      }
    });
  }
  /// Lets effects that change at given times take the piece that holds from t on.
  void enter(double t) {
    for_each([t](auto& effect) {
      if constexpr (requires { effect->enter(t); })
        if (effect) effect->enter(t);
    });
  }
  /// Torque of the brake that holds now [N m].
  T braking() const {
    return through(list, T(0.0), [](const auto& e, const T&) -> decltype(e.braking()) { return e.braking(); });
  }
  /// First time after t at which an effect changes.
  double next_knot(double t) const {
    return through(
        list, std::numeric_limits<double>::infinity(),
        [](const auto& e, double next, double now) -> decltype(e.next_knot(now)) {
          return std::min(next, e.next_knot(now));
        },
        t);
  }
  /// Whether what effects do bends where the load changes its sign.
  bool bend_with_load() const {
    return through(list, false,
                   [](const auto& e, bool any) -> decltype(e.bends_with_load()) { return any || e.bends_with_load(); });
  }
  /// Torque that the effects add on the worm shaft [N m]. M as above.
  template <class S, template <class> class M>
  S worm_torque(const M<S>& at, Motion motion) const {
    return through(
        list, S(0.0),
        []<class E>(const E& e, const S& sum, const auto& now, Motion way) -> decltype(sum + e.worm_torque(now, way)) {
          if constexpr (MayHaveStates<E> && requires { now.states; })
            if (has_states(e)) return sum + e.worm_torque(now, way, EffectStates::template of<E>(now.states));
          return sum + e.worm_torque(now, way);
        },
        at, motion);
  }
  /// Inertia that the effects add on the worm shaft [kg m^2].
  T worm_inertia() const {
    return through(list, T(0.0), [](const auto& e, const T& sum) -> decltype(sum + e.worm_inertia()) {
      return sum + e.worm_inertia();
    });
  }
  /// Coefficient of friction between the teeth out of the mesh's own; where they slide on bristles, also that under
  /// which these do. M as above.
  template <bool under_bristles = false, class S, template <class> class M>
  S friction(const S& mesh, const SlidingContact<S>& contact, const M<S>& at) const {
    return through(
        list, mesh,
        []<class E>(const E& e, const S& mu, const auto& teeth, const auto& now) -> decltype(e.friction(mu, teeth)) {
          if constexpr (under_bristles && std::is_same_v<E, MeshLuGre<T>>) return mu;
          if constexpr (MayHaveStates<E> && requires { now.states; })
            if (has_states(e)) return e.friction(mu, teeth, EffectStates::template of<E>(now.states));
          return e.friction(mu, teeth);
        },
        contact, at);
  }
  /// What friction may come to until a time [s], out of what it is without effects.
  FrictionRange friction_range(const FrictionRange& mesh, double end) const {
    return through(
        list, mesh,
        [](const auto& e, const FrictionRange& mu, double until) -> decltype(e.friction_range(mu, until)) {
          return e.friction_range(mu, until);
        },
        end);
  }
  /// Whether an effect makes the friction between the teeth another one.
  bool change_friction() const {
    return through(list, false,
                   [](const auto& e, bool) -> decltype(e.friction_range(FrictionRange{}, 0.0), true) { return true; });
  }
  /// Highest angular frequency with which friction still changes after so long at rest [s], in rad/s.
  double fastest_at_rest(double rest) const {
    return through(
        list, 0.0,
        [](const auto& e, double, double t) -> decltype(e.fastest_at_rest(t)) { return e.fastest_at_rest(t); }, rest);
  }
  /// Highest angular frequency of what effects do over the time [rad/s], moving or not.
  double fastest_in_time() const {
    return through(list, 0.0, [](const auto& e, double most) -> decltype(e.fastest_in_time()) {
      return std::max(most, e.fastest_in_time());
    });
  }
  /// Highest number of periods per radian of the gear in what effects do over its angle, for a ratio i.
  double ripple(double i) const {
    return through(
        list, 0.0,
        [](const auto& e, double most, double ratio) -> decltype(e.ripple(ratio)) {
          return std::max(most, e.ripple(ratio));
        },
        i);
  }
  /// Whether the worm does not follow the gear with the ratio i throughout.
  bool pitch_varies() const {
    return through(list, false, [](const auto& e, bool) -> decltype(e.transmission(T(0)), true) { return true; });
  }
  /// Smallest slope of the worm angle over the gear angle, per ratio i.
  double least_slope() const {
    return through(list, 1.0, [](const auto& e, double) -> decltype(e.least_slope()) { return e.least_slope(); });
  }
  /// How the worm follows the gear, per ratio i.
  template <class S>
  Transmission<S> transmission(const S& theta_g) const {
    return through(
        list, Transmission<S>{theta_g, S(T(1)), S(T(0))},
        [](const auto& e, const auto&, const S& angle) -> decltype(e.transmission(angle)) {
          return e.transmission(angle);
        },
        theta_g);
  }
  /// Torque that the effects add on the gear shaft [N m].
  template <class S>
  S gear_torque(const Moment<S>& at, Motion motion) const {
    return through(
        list, S(0.0),
        [](const auto& e, const S& sum, const auto& now, Motion way) -> decltype(sum + e.gear_torque(now, way)) {
          return sum + e.gear_torque(now, way);
        },
        at, motion);
  }
  /// The same with what hangs on the load there [N m].
  template <class S>
  S gear_torque(const S& tau_l, const Moment<S>& at, Motion motion) const {
    return through(
        list, gear_torque(at, motion),
        [](const auto& e, const S& sum, const S& load, const auto& now,
           Motion way) -> decltype(sum + e.torque_under_load(load, now, way)) {
          return sum + e.torque_under_load(load, now, way);
        },
        tau_l, at, motion);
  }
  /// Inertia that the effects add on the gear shaft [kg m^2].
  T gear_inertia() const {
    return through(list, T(0.0), [](const auto& e, const T& sum) -> decltype(sum + e.gear_inertia()) {
      return sum + e.gear_inertia();
    });
  }
  /// Whether the inertia of the gear side depends on its angle.
  bool inertia_varies() const {
    return through(list, false, [](const auto& e, bool) -> decltype(e.inertia_at(T(0)), true) { return true; });
  }
  /// What the gear side, or the load behind a coupling, feels of inertias that depend on its angle.
  template <class S>
  VaryingInertia<S> inertia_at(const S& theta_g) const {
    return through(
        list, VaryingInertia<S>{S(0.0), S(0.0)},
        [](const auto& e, const auto& sum, const S& angle) -> decltype(e.inertia_at(angle)) {
          const auto own = e.inertia_at(angle);
          return {sum.inertia + own.inertia, sum.slope + own.slope};
        },
        theta_g);
  }
  /// The coupling behind which the load turns on its own, if there is one.
  const LoadCoupling<T>* twisting_coupling() const {
    const auto& coupling = std::get<std::optional<LoadCoupling<T>>>(list);
    return coupling && has_states(*coupling) ? &*coupling : nullptr;
  }
  /// Where the load is at a moment, and how fast it turns. M as above.
  template <class S, template <class> class M>
  Moment<S> at_load(const M<S>& at) const {
    if constexpr (requires { at.states; })
      if (const auto* const coupling = twisting_coupling())
        return coupling->at_load(at, EffectStates::template of<LoadCoupling<T>>(at.states));
    return at;
  }
  /// Torque of a load on the gear, with effects [N m], while that moves, or starts to move; without states both turn.
  template <class Load, class S, template <class> class M>
  S load_torque(const Load& load, const M<S>& at, Motion motion) const {
    if constexpr (requires { at.states; })
      if (const auto* const coupling = twisting_coupling())
        return coupling->torque_on_gear(at, EffectStates::template of<LoadCoupling<T>>(at.states));
    return torque_of(load, at, motion);
  }
  /// The same where the load is.
  template <class Load, class S>
  S torque_of(const Load& load, const Moment<S>& at, Motion motion) const {
    Moment<S> seen = at;
    seen.theta_g = through(list, at.theta_g, [](const auto& e, const S& theta_g) -> decltype(e.loading_angle(theta_g)) {
      return e.loading_angle(theta_g);
    });
    const auto stated = [&]() -> S {
      if constexpr (requires { load.torque(seen, motion); })
        return load.torque(seen, motion);
      else
        return load.torque(seen);
    };
    return through(
        list, stated(),
        [](const auto& e, const S& torque, const auto& now) -> decltype(e.load_torque(torque, now)) {
          return e.load_torque(torque, now);
        },
        at);
  }
  /// Age of the angle that a sample sees [s].
  T measuring_delay() const {
    return through(list, T(0.0), [](const auto& e, const T& sum) -> decltype(sum + e.measuring_delay()) {
      return sum + e.measuring_delay();
    });
  }
  /// The gear angle as the sensor sees it [rad].
  template <class S>
  S measured_angle(const S& theta_g) const {
    return through(list, theta_g, [](const auto& e, const S& angle) -> decltype(e.measured_angle(angle)) {
      return e.measured_angle(angle);
    });
  }
};

}  // namespace wormdrive
