#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// Viscous friction on the worm shaft, -coefficient w_w.
template <class T>
struct WormViscous {
  static constexpr std::string_view id = "worm_viscous";
  static constexpr Place place = Place::worm_shaft;
  static constexpr std::string_view cause = "viscous friction (grease, motor) on the worm shaft";
  static constexpr std::string_view law = "-coefficient theta_w' on the worm";
  T coefficient{};

  static constexpr auto fields() {
    return std::tuple{Field{&WormViscous::coefficient, "coefficient", unit::newton_metre_second_per_radian,
                            bounds::not_negative, "friction torque per worm speed"}};
  }
  /// Torque on the worm shaft [N m].
  template <class S>
  S worm_torque(const Moment<S>& at, Motion) const {
    return -coefficient * at.omega_w;
  }
};

}  // namespace wormdrive
