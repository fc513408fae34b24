#pragma once
#include <array>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/numbers/portable.hpp"
#include "core/place.hpp"
#include "core/sliding_contact.hpp"
#include "core/states/effect_states.hpp"

namespace wormdrive {

/// Friction warms the gearbox, and warm oil rubs less: between the teeth, and where the worm churns it. The
/// temperature is a state; without a heat capacity it stays where it starts.
template <class T>
struct GearboxHeat {
  static constexpr std::string_view id = "gearbox_heat";
  static constexpr Place place = Place::mesh;
  static constexpr std::string_view cause = "friction warms the oil, and warmer oil causes less friction";
  static constexpr std::string_view law =
      "mu exp(-friction_decay h) between the teeth and -churning exp(-churning_decay h) theta_w' on the worm, where "
      "heat_capacity h' = P - h/thermal_resistance with P the power that friction of mesh and bearings takes; "
      "h(0) = starting_rise";
  static constexpr std::string_view source = "ISO/TR 14179-1:2001 (heat balance); O. Reynolds, Phil. Trans. 177 (1886)";
  T friction_decay{0};
  T churning{0};
  T churning_decay{0};
  std::optional<T> heat_capacity{};
  std::optional<T> thermal_resistance{};
  T starting_rise{0};

  static constexpr auto fields() {
    using P = GearboxHeat;
    constexpr Presence o = Presence::optional;
    return std::tuple{Field{&P::friction_decay, "friction_decay", unit::per_kelvin, bounds::not_negative,
                            "share by which the friction between the teeth falls per kelvin", o},
                      Field{&P::churning, "churning", unit::newton_metre_second_per_radian, bounds::not_negative,
                            "viscous friction at the worm while the oil has the temperature of the surroundings", o},
                      Field{&P::churning_decay, "churning_decay", unit::per_kelvin, bounds::not_negative,
                            "share by which that friction falls per kelvin, as the viscosity does", o},
                      Field{&P::heat_capacity, "heat_capacity", unit::joule_per_kelvin, bounds::positive,
                            "of the housing with gear, worm and oil; if not stated the temperature stays constant", o},
                      Field{&P::thermal_resistance, "thermal_resistance", unit::kelvin_per_watt, bounds::positive,
                            "from the housing to its surroundings; if not stated no heat leaves", o},
                      Field{&P::starting_rise, "starting_rise", unit::kelvin, bounds::not_negative,
                            "temperature at the start, above that of the surroundings", o}};
  }

  // ---- its state ----------------------------------------------------------------------------------------------

  static constexpr std::array states{
      EffectState{"temperature_rise", unit::kelvin, "temperature of the gearbox above that of its surroundings"}};
  static constexpr std::string_view without_states = "leave heat_capacity_J_per_K out";
  bool has_state(std::size_t) const { return heat_capacity.has_value(); }
  std::array<T, 1> starting_states() const { return {starting_rise}; }
  /// h' [K/s] where friction takes a power [W].
  template <class S>
  std::array<S, 1> state_rates(const S& friction_loss, const std::array<S, 1>& h) const {
    const S warms = friction_loss / *heat_capacity;
    return {thermal_resistance ? S(warms - h[0] / (*thermal_resistance * *heat_capacity)) : warms};
  }

  // ---- what it does -------------------------------------------------------------------------------------------

  /// Coefficient of friction out of that of a gearbox as warm as its surroundings, at the start ...
  template <class S>
  S friction(const S& mu, const SlidingContact<S>& at) const {
    return friction(mu, at, std::array{S(starting_rise)});
  }
  /// ... and with its state.
  template <class S>
  S friction(const S& mu, const SlidingContact<S>&, const std::array<S, 1>& h) const {
    return mu * fallen(friction_decay, h[0]);
  }
  /// What the oil does to the worm [N m], at the start ...
  template <class S>
  S worm_torque(const Moment<S>& at, Motion motion) const {
    return worm_torque(at, motion, std::array{S(starting_rise)});
  }
  /// ... and with its state.
  template <class S>
  S worm_torque(const Moment<S>& at, Motion, const std::array<S, 1>& h) const {
    return S(T(-1) * churning) * at.omega_w * fallen(churning_decay, h[0]);
  }
  /// It is never colder than its surroundings.
  FrictionRange friction_range(const FrictionRange& mu, double) const {
    return {friction_decay > 0.0 ? 0.0 : mu.low, mu.high};
  }

 private:
  template <class S>
  static S fallen(const T& decay, const S& h) {
    using portable::exp;
    return exp(S(T(-1) * decay * h));
  }
};

}  // namespace wormdrive
