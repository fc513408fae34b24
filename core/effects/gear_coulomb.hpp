#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// Dry friction in the gear's bearings, -motion torque.
template <class T>
struct GearCoulomb {
  static constexpr std::string_view id = "gear_coulomb";
  static constexpr Place place = Place::gear_shaft;
  static constexpr std::string_view cause = "dry friction in the bearings and seals of the gear shaft";
  static constexpr std::string_view law = "-torque sgn(theta_g') on the gear; at rest it holds up to torque";
  static constexpr std::string_view source = "C. A. Coulomb, Theorie des machines simples, 1785";
  T torque{};

  static constexpr auto fields() {
    return std::tuple{Field{&GearCoulomb::torque, "torque", unit::newton_metre, bounds::not_negative,
                            "friction torque while the gear turns"}};
  }
  /// Torque on the gear shaft [N m].
  template <class S>
  S gear_torque(const Moment<S>&, Motion motion) const {
    return S(-sign(motion) * torque);
  }
};

}  // namespace wormdrive
