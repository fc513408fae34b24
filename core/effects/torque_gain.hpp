#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// The motor gives a share more, or less, than its command: (1 + share) u.
template <class T>
struct TorqueGain {
  static constexpr std::string_view id = "torque_gain";
  static constexpr Place place = Place::actuator;
  static constexpr std::string_view cause =
      "the torque constant of the motor or the gain of its amplifier is not what was assumed";
  static constexpr std::string_view law = "tau_m = (1 + share) u";
  T share{};

  static constexpr auto fields() {
    return std::tuple{Field{&TorqueGain::share, "share", unit::none, Bounds{.low = -1.0, .low_exclusive = true},
                            "torque that the motor gives in excess of its command, as a share of the command"}};
  }
  /// Motor torque [N m] for a command.
  template <class S>
  S motor_torque(const S& command, const Moment<S>&) const {
    return command + share * command;
  }
};

}  // namespace wormdrive
