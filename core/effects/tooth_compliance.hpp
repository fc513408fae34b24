#pragma once
#include <optional>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// The teeth yield: worm and gear are two inertias on an elastic contact, and the damping stated selects its law.
template <class T>
struct ToothCompliance {
  static constexpr std::string_view id = "tooth_compliance";
  static constexpr Place place = Place::mesh;
  static constexpr std::string_view cause = "teeth bend and flatten under load, and so do shafts and housing";
  static constexpr std::string_view law =
      "Wn = stiffness d (1 + damping d') or stiffness d + min(stiffness d, damping d') at the penetration d of a flank";
  static constexpr std::string_view source =
      "K. Hunt, F. Crossley, J. Appl. Mech. 42 (1975) 440; ElastoBacklash of the Modelica Standard Library 4.1.0";
  T stiffness{};
  std::optional<T> growing_damping{};  ///< of HuntCrossley [s/m]
  std::optional<T> limited_damping{};  ///< of LimitedDamper [N s/m]

  static constexpr auto fields() {
    using P = ToothCompliance;
    constexpr Presence o = Presence::optional;
    return std::tuple{
        Field{&P::stiffness, "stiffness", unit::newton_per_metre, bounds::positive,
              "normal force per normal deflection of the teeth"},
        Field{&P::growing_damping, "damping", unit::second_per_metre, bounds::not_negative,
              "law of Hunt and Crossley: share of the elastic force that damping adds per approach speed", o},
        Field{&P::limited_damping, "damping", unit::newton_second_per_metre, bounds::not_negative,
              "instead, a damper limited to the elastic force: normal force per approach speed", o}};
  }
};

}  // namespace wormdrive
