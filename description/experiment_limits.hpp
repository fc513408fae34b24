#pragma once
#include <optional>
#include <tuple>

#include "core/field.hpp"

namespace wormdrive {

/// How far a drive may be driven: a diagnosis proposes no experiment beyond. What is not stated follows from the
/// recordings and from stops that are stated.
struct ExperimentLimits {
  std::optional<double> torque{};   ///< of the motor, either way [N m]
  std::optional<double> speed{};    ///< of the gear, either way [rad/s]
  std::optional<double> low, high;  ///< of the gear's angle [rad]

  static constexpr auto fields() {
    using P = ExperimentLimits;
    constexpr Presence o = Presence::optional;
    return std::tuple{
        Field{&P::torque, "torque", unit::newton_metre, bounds::positive, "largest torque of the motor, either way", o},
        Field{&P::speed, "speed", unit::radian_per_second, bounds::positive, "largest speed of the gear, either way",
              o},
        Field{&P::low, "angle_low", unit::degrees, bounds::any, "lowest gear angle", o},
        Field{&P::high, "angle_high", unit::degrees, bounds::any, "highest gear angle", o}};
  }
};

}  // namespace wormdrive
