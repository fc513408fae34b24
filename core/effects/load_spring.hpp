#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// A spring between gear and ground beside the load: -stiffness (theta_g - angle).
template <class T>
struct LoadSpring {
  static constexpr std::string_view id = "load_spring";
  static constexpr Place place = Place::load;
  static constexpr std::string_view cause = "a cable, a hose or a balancing spring pulls the gear towards an angle";
  static constexpr std::string_view law = "tau_l - stiffness (theta_g - angle)";
  T stiffness{};
  T rest{};

  static constexpr auto fields() {
    return std::tuple{
        Field{&LoadSpring::stiffness, "stiffness", unit::newton_metre_per_radian, bounds::any, "torque per gear angle"},
        Field{&LoadSpring::rest, "angle", unit::degrees, bounds::any, "gear angle at which the spring is relaxed"}};
  }
  /// Load torque [N m] out of that without this effect.
  template <class S>
  S load_torque(const S& torque, const Moment<S>& at) const {
    return torque - stiffness * (at.theta_g - rest);
  }
};

}  // namespace wormdrive
