#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// The motor's torque follows its command as a first-order lag: time tau_m' = command - tau_m, from 0 at the start.
template <class T>
struct ActuatorLag {
  static constexpr std::string_view id = "actuator_lag";
  static constexpr Place place = Place::actuator;
  static constexpr std::string_view cause = "the current loop of the motor needs time to build up the torque";
  static constexpr std::string_view law = "time_constant tau_m' = u - tau_m, from 0 at the start";
  T time{};

  static constexpr auto fields() {
    return std::tuple{Field{&ActuatorLag::time, "time_constant", unit::second, bounds::positive,
                            "time after which 63 % of a step has arrived"}};
  }
  /// Time constant of the lag [s].
  T lag() const { return time; }
};

}  // namespace wormdrive
