#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// Viscous friction on the gear shaft, -coefficient w_g.
template <class T>
struct GearViscous {
  static constexpr std::string_view id = "gear_viscous";
  static constexpr Place place = Place::gear_shaft;
  static constexpr std::string_view cause = "viscous friction on the gear shaft or in the load";
  static constexpr std::string_view law = "-coefficient theta_g' on the gear";
  T coefficient{};

  static constexpr auto fields() {
    return std::tuple{Field{&GearViscous::coefficient, "coefficient", unit::newton_metre_second_per_radian,
                            bounds::not_negative, "friction torque per gear speed"}};
  }
  /// Torque on the gear shaft [N m].
  template <class S>
  S gear_torque(const Moment<S>& at, Motion) const {
    return -coefficient * at.omega_g;
  }
};

}  // namespace wormdrive
