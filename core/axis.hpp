#pragma once
#include <string>

namespace wormdrive {

/// What the drive turns or moves: a shaft (rad, N m, kg m^2) or a slide (m, N, kg).
enum class Axis { rotary, linear };

/// The units on an axis of what has these units on a shaft: "rad/s" becomes "m/s", "N m" becomes "N".
inline std::string units_on(Axis axis, const std::string& rotary) {
  if (axis == Axis::rotary) return rotary;
  if (rotary == "N m") return "N";
  if (rotary == "N m s") return "N s";
  std::string linear = rotary;
  if (rotary.starts_with("rad")) linear.replace(0, 3, 1, 'm');
  return linear;
}

}  // namespace wormdrive
