#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// The motor's torque is its command some time ago, and 0 before the first command has arrived.
template <class T>
struct ActuatorDelay {
  static constexpr std::string_view id = "actuator_delay";
  static constexpr Place place = Place::actuator;
  static constexpr std::string_view cause =
      "the command travels over a bus, or the amplifier computes, before the motor acts";
  static constexpr std::string_view law = "tau_m(t) = u(t - delay), 0 before the first command has arrived";
  T time{};

  static constexpr auto fields() {
    return std::tuple{
        Field{&ActuatorDelay::time, "delay", unit::second, bounds::not_negative, "time from command to torque"}};
  }
  /// Delay of the command [s].
  T delay() const { return time; }
};

}  // namespace wormdrive
