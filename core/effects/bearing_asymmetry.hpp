#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// The worm's bearings resist forward motion more than backward: dry and viscous friction differ by +-torque and
/// +-coefficient from their means, which worm_coulomb and worm_viscous state.
template <class T>
struct BearingAsymmetry {
  static constexpr std::string_view id = "bearing_asymmetry";
  static constexpr Place place = Place::worm_shaft;
  static constexpr std::string_view cause = "a preloaded bearing or a seal resists one direction more than the other";
  static constexpr std::string_view law =
      "-(torque + coefficient |theta_w'|) on the worm, beside worm_coulomb and worm_viscous: more friction forward, "
      "less backward";
  static constexpr std::string_view source = "A. Janot, M. Gautier, M. Brunot, EMPS benchmark, 2019";
  T torque{};
  T coefficient{};

  static constexpr auto fields() {
    return std::tuple{Field{&BearingAsymmetry::torque, "torque", unit::newton_metre, bounds::any,
                            "friction torque above the mean forward, below it backward"},
                      Field{&BearingAsymmetry::coefficient, "coefficient", unit::newton_metre_second_per_radian,
                            bounds::any, "friction torque per worm speed above the mean forward, below it backward"}};
  }
  /// Torque on the worm shaft [N m].
  template <class S>
  S worm_torque(const Moment<S>& at, Motion motion) const {
    return -coefficient * T(sign(motion)) * at.omega_w - T(sign(motion) * sign(motion)) * torque;
  }
};

}  // namespace wormdrive
