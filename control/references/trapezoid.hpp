#pragma once
#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

#include "control/reference_point.hpp"
#include "core/field.hpp"

namespace wormdrive {

/// A move with trapezoidal speed: constant acceleration, cruise, constant deceleration; a triangle if it is short.
struct TrapezoidReference {
  static constexpr std::string_view kind = "trapezoid";
  static constexpr std::string_view meaning = "a move with trapezoidal speed";
  double angle{};
  double max_speed{};
  double acceleration{};
  double start{0.0};

  static constexpr auto fields() {
    using P = TrapezoidReference;
    return std::tuple{
        Field{&P::angle, "angle", unit::radian, bounds::any, "angle of the whole move"},
        Field{&P::max_speed, "max_speed", unit::radian_per_second, bounds::positive, "speed of the cruise"},
        Field{&P::acceleration, "acceleration", unit::radian_per_second_squared, bounds::positive,
              "acceleration and deceleration"},
        Field{&P::start, "start", unit::second, bounds::any, "time at which the move begins", Presence::optional}};
  }
  bool operator==(const TrapezoidReference&) const = default;
  ReferencePoint at(double t) const {
    const double sign = angle < 0.0 ? -1.0 : 1.0, distance = std::abs(angle);
    const double ramp = std::min(max_speed / acceleration, std::sqrt(distance / acceleration));
    const double top = acceleration * ramp;
    const double cruise = ramp > 0.0 ? distance / top - ramp : 0.0;
    const double s = t - start, end = 2.0 * ramp + cruise;
    if (s <= 0.0) return {};
    if (s < ramp) return {sign * 0.5 * acceleration * s * s, sign * acceleration * s, sign * acceleration};
    if (s < ramp + cruise) return {sign * top * (s - 0.5 * ramp), sign * top, 0.0};
    if (s < end) {
      const double left = end - s;
      return {sign * (distance - 0.5 * acceleration * left * left), sign * acceleration * left, -sign * acceleration};
    }
    return {angle, 0.0, 0.0};
  }
};

}  // namespace wormdrive
