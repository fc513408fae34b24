#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// The load is mounted at another angle: it sees the gear angle plus a shift.
template <class T>
struct LoadAngle {
  static constexpr std::string_view id = "load_angle";
  static constexpr Place place = Place::load;
  static constexpr std::string_view cause = "the arm is mounted at another angle, or the drive stands tilted";
  static constexpr std::string_view law = "tau_l at theta_g + angle";
  T shift{};

  static constexpr auto fields() {
    return std::tuple{
        Field{&LoadAngle::shift, "angle", unit::degrees, bounds::any, "angle of the load ahead of the gear angle"}};
  }
  /// The gear angle that the load sees [rad].
  template <class S>
  S loading_angle(const S& theta_g) const {
    return theta_g + shift;
  }
};

}  // namespace wormdrive
