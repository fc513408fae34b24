#pragma once
#include <limits>
#include <optional>
#include <tuple>

#include "core/effects/encoder_offset.hpp"
#include "core/effects/gear_coulomb.hpp"
#include "core/effects/gear_viscous.hpp"
#include "core/effects/torque_saturation.hpp"
#include "core/effects/worm_coulomb.hpp"
#include "core/effects/worm_viscous.hpp"

namespace wormdrive {

/// Every effect that can extend the nominal drive, off unless stated; a new one is a new file and one entry here.
///
/// An effect is switched by its presence, not by a zero parameter: a fit starts at zero and needs the gradient there.
template <class T>
using EffectList = std::tuple<std::optional<TorqueSaturation<T>>, std::optional<WormCoulomb<T>>,
                              std::optional<WormViscous<T>>, std::optional<GearCoulomb<T>>,
                              std::optional<GearViscous<T>>, std::optional<EncoderOffset<T>>>;

/// The effects of a drive, asked place by place; an effect answers only where it has a hook.
template <class T>
struct Effects {
  EffectList<T> list;

  /// Calls visit(optional effect) for every effect of the catalogue.
  template <class Visit>
  void for_each(Visit&& visit) {
    std::apply([&](auto&... effect) { (visit(effect), ...); }, list);
  }
  template <class Visit>
  void for_each(Visit&& visit) const {
    std::apply([&](const auto&... effect) { (visit(effect), ...); }, list);
  }

  /// Largest magnitude of the motor torque [N m], infinity without a limit.
  T torque_limit() const {
    T limit(std::numeric_limits<double>::infinity());
    for_each([&](const auto& effect) {
      if constexpr (requires { effect->torque_limit(); })
        if (effect && effect->torque_limit() < limit) limit = effect->torque_limit();
    });
    return limit;
  }

  /// The gear angle as the sensor sees it [rad].
  template <class S>
  S measured_angle(S theta_g) const {
    for_each([&](const auto& effect) {
      if constexpr (requires { effect->measured_angle(theta_g); })
        if (effect) theta_g = effect->measured_angle(theta_g);
    });
    return theta_g;
  }

  /// Torque that the effects add on the worm shaft [N m].
  template <class S>
  S worm_torque(const Moment<S>& at, Motion motion) const {
    S sum(0.0);
    for_each([&](const auto& effect) {
      if constexpr (requires { effect->worm_torque(at, motion); })
        if (effect) sum += effect->worm_torque(at, motion);
    });
    return sum;
  }

  /// Torque that the effects add on the gear shaft [N m].
  template <class S>
  S gear_torque(const Moment<S>& at, Motion motion) const {
    S sum(0.0);
    for_each([&](const auto& effect) {
      if constexpr (requires { effect->gear_torque(at, motion); })
        if (effect) sum += effect->gear_torque(at, motion);
    });
    return sum;
  }
};

}  // namespace wormdrive
