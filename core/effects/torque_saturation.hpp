#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// The motor or its amplifier gives no more than a limit: the command is cut at +-limit.
template <class T>
struct TorqueSaturation {
  static constexpr std::string_view id = "torque_saturation";
  static constexpr Place place = Place::actuator;
  static constexpr std::string_view cause = "the motor or its amplifier gives no more than a limiting torque";
  static constexpr std::string_view law = "tau_m = min(max(u, -limit), limit)";
  T limit{};

  static constexpr auto fields() {
    return std::tuple{Field{&TorqueSaturation::limit, "limit", unit::newton_metre, bounds::positive,
                            "largest motor torque in either direction"}};
  }
  /// Largest magnitude of the motor torque [N m].
  T torque_limit() const { return limit; }
};

}  // namespace wormdrive
