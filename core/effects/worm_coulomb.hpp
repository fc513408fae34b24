#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// Dry friction in the worm's bearings, -motion torque.
template <class T>
struct WormCoulomb {
  static constexpr std::string_view id = "worm_coulomb";
  static constexpr Place place = Place::worm_shaft;
  static constexpr std::string_view cause = "dry friction in the bearings and seals of the worm shaft";
  static constexpr std::string_view law = "-torque sgn(theta_w') on the worm; at rest it holds up to torque";
  static constexpr std::string_view source = "C. A. Coulomb, Theorie des machines simples, 1785";
  T torque{};

  static constexpr auto fields() {
    return std::tuple{Field{&WormCoulomb::torque, "torque", unit::newton_metre, bounds::not_negative,
                            "friction torque while the worm turns"}};
  }
  /// Torque on the worm shaft [N m].
  template <class S>
  S worm_torque(const Moment<S>&, Motion motion) const {
    return S(-sign(motion) * torque);
  }
};

}  // namespace wormdrive
