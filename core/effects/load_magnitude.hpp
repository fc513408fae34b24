#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// The load is a share heavier, or lighter, than stated; its inertia stays.
template <class T>
struct LoadMagnitude {
  static constexpr std::string_view id = "load_magnitude";
  static constexpr Place place = Place::load;
  static constexpr std::string_view cause = "the payload or its arm is not what was assumed";
  static constexpr std::string_view law = "(1 + share) tau_l";
  T share{};

  static constexpr auto fields() {
    return std::tuple{Field{&LoadMagnitude::share, "share", unit::none, bounds::any,
                            "excess of the load torque, as a share of the stated one"}};
  }
  /// Load torque [N m] out of that without this effect.
  template <class S>
  S load_torque(const S& torque, const Moment<S>&) const {
    return torque + share * torque;
  }
};

}  // namespace wormdrive
