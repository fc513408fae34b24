#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// The encoder's angle is a share too large, or too small: (1 + share) theta_g.
template <class T>
struct EncoderScale {
  static constexpr std::string_view id = "encoder_scale";
  static constexpr Place place = Place::sensor;
  static constexpr std::string_view cause = "counts per turn, or a gear before the encoder, are not what was assumed";
  static constexpr std::string_view law = "(1 + share) theta_g";
  T share{};

  static constexpr auto fields() {
    return std::tuple{Field{&EncoderScale::share, "share", unit::none, Bounds{.low = -1.0, .low_exclusive = true},
                            "excess of the encoder's reading, as a share of the gear angle"}};
  }
  /// The angle that the sensor sees [rad].
  template <class S>
  S measured_angle(const S& theta_g) const {
    return theta_g + share * theta_g;
  }
};

}  // namespace wormdrive
