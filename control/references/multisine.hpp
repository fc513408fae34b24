#pragma once
#include <numbers>
#include <string_view>
#include <tuple>

#include "control/reference_point.hpp"
#include "core/field.hpp"

namespace wormdrive {

/// Equal sines at equally spaced frequencies with Schroeder's phases, which keep the peak low.
struct MultisineReference {
  static constexpr std::string_view kind = "multisine";
  static constexpr std::string_view meaning = "equal sines at equally spaced frequencies with Schroeder's phases";
  double amplitude{};
  double lowest_frequency{};
  double highest_frequency{};
  double count{8};

  static constexpr auto fields() {
    using P = MultisineReference;
    return std::tuple{
        Field{&P::amplitude, "amplitude", unit::radian, bounds::any, "amplitude of each sine"},
        Field{&P::lowest_frequency, "lowest_frequency", unit::hertz, bounds::positive, "lowest frequency"},
        Field{&P::highest_frequency, "highest_frequency", unit::hertz, bounds::positive, "highest frequency"},
        Field{&P::count, "count", unit::whole, bounds::between(1, 1000), "number of sines", Presence::optional}};
  }
  bool operator==(const MultisineReference&) const = default;
  ReferencePoint at(double t) const {
    ReferencePoint sum;
    const int n = static_cast<int>(count);
    for (int k = 0; k < n; ++k) {
      const double share = n > 1 ? static_cast<double>(k) / (n - 1) : 0.0;
      const double frequency = lowest_frequency + share * (highest_frequency - lowest_frequency);
      sum += sine_point(amplitude, frequency * t - 0.5 * k * (k - 1) / n, frequency);
    }
    return sum;
  }
};

}  // namespace wormdrive
