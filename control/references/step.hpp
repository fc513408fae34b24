#pragma once
#include <string_view>
#include <tuple>

#include "control/reference_point.hpp"
#include "core/field.hpp"

namespace wormdrive {

/// 0 before a time, an angle from then on.
struct StepReference {
  static constexpr std::string_view kind = "step";
  static constexpr std::string_view meaning = "0 before a time, an angle from then on";
  double angle{};
  double time{};

  static constexpr auto fields() {
    using P = StepReference;
    return std::tuple{Field{&P::angle, "angle", unit::radian, bounds::any, "angle after the step"},
                      Field{&P::time, "time", unit::second, bounds::any, "time of the step"}};
  }
  bool operator==(const StepReference&) const = default;
  ReferencePoint at(double t) const { return {t >= time ? angle : 0.0, 0.0, 0.0}; }
};

}  // namespace wormdrive
