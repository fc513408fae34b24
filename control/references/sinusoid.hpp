#pragma once
#include <numbers>
#include <string_view>
#include <tuple>

#include "control/reference_point.hpp"
#include "core/field.hpp"

namespace wormdrive {

/// amplitude sin(2 pi frequency t + phase).
struct SinusoidReference {
  static constexpr std::string_view kind = "sinusoid";
  static constexpr std::string_view meaning = "amplitude sin(2 pi frequency t + phase)";
  double amplitude{};
  double frequency{};
  double phase{0.0};

  static constexpr auto fields() {
    using P = SinusoidReference;
    return std::tuple{Field{&P::amplitude, "amplitude", unit::radian, bounds::any, "amplitude of the sine"},
                      Field{&P::frequency, "frequency", unit::hertz, bounds::positive, "frequency"},
                      Field{&P::phase, "phase", unit::degrees, bounds::any, "phase at t = 0", Presence::optional}};
  }
  bool operator==(const SinusoidReference&) const = default;
  ReferencePoint at(double t) const {
    return sine_point(amplitude, frequency * t + phase * (0.5 * std::numbers::inv_pi), frequency);
  }
};

}  // namespace wormdrive
