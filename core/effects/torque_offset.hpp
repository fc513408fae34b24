#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// The motor gives a constant torque on top of its command.
template <class T>
struct TorqueOffset {
  static constexpr std::string_view id = "torque_offset";
  static constexpr Place place = Place::actuator;
  static constexpr std::string_view cause = "the amplifier's zero is off, or a constant torque acts on the motor";
  static constexpr std::string_view law = "tau_m = u + torque";
  T torque{};

  static constexpr auto fields() {
    return std::tuple{
        Field{&TorqueOffset::torque, "torque", unit::newton_metre, bounds::any, "motor torque at a command of zero"}};
  }
  /// Motor torque [N m] for a command.
  template <class S>
  S motor_torque(const S& command, const Moment<S>&) const {
    return command + torque;
  }
};

}  // namespace wormdrive
