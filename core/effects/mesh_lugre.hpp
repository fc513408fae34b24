#pragma once
#include <array>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/place.hpp"
#include "core/sliding_contact.hpp"
#include "core/states/bristles.hpp"
#include "core/states/effect_states.hpp"

namespace wormdrive {

/// Friction between the teeth by bristles that bend before they slide [Canudas de Wit et al. 1995], those of Dahl
/// [1968] where friction does not fall with the speed. What they slide under is the coefficient that mesh and other
/// effects state; what they carry is a state, as a coefficient. No gear rests on them: it stands, or swings, where they
/// balance it.
template <class T>
struct MeshLuGre {
  static constexpr std::string_view id = "mesh_lugre";
  static constexpr Place place = Place::mesh;
  static constexpr std::string_view cause = "the teeth deflect a little before they slide, and spring back";
  static constexpr std::string_view law =
      "h + damping z' in the place of mu sgn(v) between teeth that slide with v, where the bristles carry h = "
      "stiffness "
      "z and bend by z' = v - |v| h/mu";
  static constexpr std::string_view source =
      "C. Canudas de Wit et al., IEEE Trans. Automatic Control 40 (1995) 419-425; P. R. Dahl, TOR-158, Aerospace "
      "Corporation, 1968";
  static constexpr Exclusion excludes[] = {
      {"static_friction",
       "teeth on bristles do not rest; effect.stribeck states friction that falls behind break-away"}};
  T stiffness{};
  T damping{0};

  static constexpr auto fields() {
    return std::tuple{
        Field{&MeshLuGre::stiffness, "stiffness", unit::per_metre, bounds::positive,
              "rise of the coefficient of friction per sliding distance just after a reversal"},
        Field{&MeshLuGre::damping, "damping", unit::second_per_metre, bounds::not_negative,
              "rise of the coefficient of friction per speed at which the bristles bend", Presence::optional}};
  }

  // ---- its state ----------------------------------------------------------------------------------------------

  static constexpr std::array states{EffectState{
      "friction", unit::none, "coefficient of friction of the bristles between the teeth, negative backward"}};
  static constexpr std::string_view without_states = "leave it out";
  bool has_state(std::size_t) const { return true; }
  /// h' [1/s] of bristles that slide under a coefficient.
  template <class S>
  std::array<S, 1> state_rates(const S& mu, const SlidingContact<S>& at, const std::array<S, 1>& h) const {
    return {S(stiffness * bending(mu, at, h[0]))};
  }

  // ---- what it does -------------------------------------------------------------------------------------------

  /// Coefficient of friction out of that under which the bristles slide: that one where nothing is known of them ...
  template <class S>
  S friction(const S& mu, const SlidingContact<S>&) const {
    return mu;
  }
  /// ... and with what they carry, in the direction of the motion.
  template <class S>
  S friction(const S& mu, const SlidingContact<S>& at, const std::array<S, 1>& h) const {
    const S carried = damping > T(0) ? S(h[0] + damping * bending(mu, at, h[0])) : h[0];
    return T(sign(at.motion)) * carried;
  }
  FrictionRange friction_range(const FrictionRange& mu, double) const { return mu; }

 private:
  /// z' [m/s].
  template <class S>
  S bending(const S& mu, const SlidingContact<S>& at, const S& h) const {
    return bending_of_bristles<T>(at.sliding_speed, at.motion, S(h / mu));
  }
};

}  // namespace wormdrive
