#pragma once
#include <cmath>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/numbers/portable.hpp"
#include "core/place.hpp"
#include "core/transmission.hpp"

namespace wormdrive {

/// The pitch of the gear is uneven: theta_w = i (theta_g + amplitude sin(theta_g + phase)).
template <class T>
struct TransmissionError {
  static constexpr std::string_view id = "transmission_error";
  static constexpr Place place = Place::mesh;
  static constexpr std::string_view cause = "the gear is cut or mounted off its centre";
  static constexpr std::string_view law = "theta_w = i (theta_g + amplitude sin(theta_g + phase))";
  static constexpr Exclusion excludes[] = {{"tooth_compliance", "elastic teeth run at an even pitch"}};
  T amplitude{};
  T phase{};

  static constexpr auto fields() {
    return std::tuple{
        Field{&TransmissionError::amplitude, "amplitude", unit::degrees, Bounds{-0.5, 0.5, true, true},
              "largest lead of the worm, as an angle at the gear"},
        Field{&TransmissionError::phase, "phase", unit::degrees, bounds::any, "phase at gear angle zero"}};
  }
  /// Smallest slope of the worm angle over the gear angle, per ratio i.
  double least_slope() const { return 1.0 - std::abs(amplitude); }
  double ripple(double) const { return amplitude != T(0) ? 1.0 : 0.0; }
  /// How the worm follows the gear, per ratio i.
  template <class S>
  Transmission<S> transmission(const S& theta_g) const {
    using portable::cos, portable::sin;
    const S x = theta_g + phase, s = amplitude * sin(x);
    return {theta_g + s, S(T(1)) + amplitude * cos(x), -s};
  }
};

}  // namespace wormdrive
