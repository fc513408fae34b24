#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// The encoder's zero is not the drive's: it shows the angle plus a constant.
template <class T>
struct EncoderOffset {
  static constexpr std::string_view id = "encoder_offset";
  static constexpr Place place = Place::sensor;
  static constexpr std::string_view cause = "the encoder's zero is not the zero of the gear angle";
  static constexpr std::string_view law = "theta_g + angle";
  T angle{};

  static constexpr auto fields() {
    return std::tuple{
        Field{&EncoderOffset::angle, "angle", unit::radian, bounds::any, "excess of the encoder's reading"}};
  }
  /// The angle that the sensor sees [rad].
  template <class S>
  S measured_angle(const S& theta_g) const {
    return theta_g + angle;
  }
};

}  // namespace wormdrive
