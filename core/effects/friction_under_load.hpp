#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/numbers/series.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// Friction that grows with the load on the gear, -motion share |tau_l|. Where the load changes its sign the torque
/// bends and does not jump.
template <class T>
struct FrictionUnderLoad {
  static constexpr std::string_view id = "friction_under_load";
  static constexpr Place place = Place::gear_shaft;
  static constexpr std::string_view cause =
      "bearings and wheels behind the gear cause more friction, the more load they carry";
  static constexpr std::string_view law = "-share |tau_l| sgn(theta_g') on the gear; at rest it holds up to that";
  static constexpr std::string_view source =
      "P. Hamon, M. Gautier, P. Garrec, Dynamic identification of robots with a dry friction model depending on load "
      "and velocity, IROS 2010";
  T share{};

  static constexpr auto fields() {
    return std::tuple{Field{&FrictionUnderLoad::share, "share", unit::none, bounds::not_negative,
                            "friction torque while the gear turns, per load torque"}};
  }
  /// Whether its torque bends where tau_l passes zero.
  bool bends_with_load() const { return !(share == T(0)); }
  /// Torque on the gear shaft under a load [N m].
  template <class S>
  S torque_under_load(const S& tau_l, const Moment<S>&, Motion motion) const {
    const S size = is_positive(tau_l) ? tau_l : -tau_l;
    return S(-sign(motion) * share) * size;
  }
};

}  // namespace wormdrive
