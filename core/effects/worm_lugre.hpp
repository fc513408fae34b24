#pragma once
#include <array>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/numbers/portable.hpp"
#include "core/place.hpp"
#include "core/states/bristles.hpp"
#include "core/states/effect_states.hpp"

namespace wormdrive {

/// Friction of the worm's bearings by bristles that bend before they slide [Canudas de Wit et al. 1995], those of Dahl
/// [1968] where nothing but coulomb_torque and stiffness is stated. Their deflection is a state, as the share h of that
/// at which they slide under coulomb_torque: z = coulomb_torque h/stiffness. Bristles that do not bend leave the
/// friction of Coulomb and Stribeck.
template <class T>
struct WormLuGre {
  static constexpr std::string_view id = "worm_lugre";
  static constexpr Place place = Place::worm_shaft;
  static constexpr std::string_view cause =
      "bearings and seals of the worm shaft deflect a little before they slide, and spring back";
  static constexpr std::string_view law =
      "-(coulomb_torque h + damping z') on the worm, where z = coulomb_torque h/stiffness bends by "
      "z' = theta_w' - |theta_w'| coulomb_torque h/g and slides at g = coulomb_torque + (static_torque - "
      "coulomb_torque) exp(-(theta_w'/stribeck_speed)^2); -g sgn(theta_w') without stiffness";
  static constexpr std::string_view source =
      "C. Canudas de Wit et al., IEEE Trans. Automatic Control 40 (1995) 419-425; P. R. Dahl, TOR-158, Aerospace "
      "Corporation, 1968";
  T coulomb_torque{};
  std::optional<T> static_torque{};
  std::optional<T> stribeck_speed{};
  std::optional<T> stiffness{};
  std::optional<T> damping{};

  static constexpr auto fields() {
    using P = WormLuGre;
    constexpr Presence o = Presence::optional;
    return std::tuple{Field{&P::coulomb_torque, "coulomb_torque", unit::newton_metre, bounds::positive,
                            "friction torque at high speed"},
                      Field{&P::static_torque, "static_torque", unit::newton_metre, bounds::positive,
                            "friction torque at low speed; coulomb_torque if not stated", o},
                      Field{&P::stribeck_speed, "stribeck_speed", unit::radian_per_second, bounds::positive,
                            "worm speed at which 63 % of the difference has gone", o},
                      Field{&P::stiffness, "stiffness", unit::newton_metre_per_radian, bounds::positive,
                            "of the bristles; if not stated they are rigid", o},
                      Field{&P::damping, "damping", unit::newton_metre_second_per_radian, bounds::not_negative,
                            "of the bristles; 0 if not stated", o}};
  }

  // ---- its state ----------------------------------------------------------------------------------------------

  static constexpr std::array states{
      EffectState{"deflection", unit::none, "deflection of the bristles, 1 where they slide under coulomb_torque"}};
  static constexpr std::string_view without_states = "leave stiffness_Nm_per_rad out";
  bool has_state(std::size_t) const { return stiffness.has_value(); }
  /// h' [1/s].
  template <class S>
  std::array<S, 1> state_rates(const S&, const Moment<S>& at, Motion motion, const std::array<S, 1>& h) const {
    return {S(*stiffness / coulomb_torque * bending(at, motion, h[0]))};
  }

  // ---- what it does -------------------------------------------------------------------------------------------

  /// Torque on the worm shaft [N m] where the bristles do not bend ...
  template <class S>
  S worm_torque(const Moment<S>& at, Motion motion) const {
    return S(T(-sign(motion)) * sliding_torque(at));
  }
  /// ... and where they do.
  template <class S>
  S worm_torque(const Moment<S>& at, Motion motion, const std::array<S, 1>& h) const {
    const S spring = coulomb_torque * h[0];
    return damping ? S(-spring - *damping * bending(at, motion, h[0])) : S(-spring);
  }

 private:
  /// g [N m].
  template <class S>
  S sliding_torque(const Moment<S>& at) const {
    using portable::exp;
    if (!static_torque || !stribeck_speed) return S(coulomb_torque);
    const S x = at.omega_w / *stribeck_speed;
    return coulomb_torque + (*static_torque - coulomb_torque) * exp(-(x * x));
  }
  /// z' [rad/s].
  template <class S>
  S bending(const Moment<S>& at, Motion motion, const S& h) const {
    return bending_of_bristles<T>(at.omega_w, motion, S(coulomb_torque * h / sliding_torque(at)));
  }
};

}  // namespace wormdrive
