#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// A sample shows the gear angle of some time ago; before that time the angle at the start.
template <class T>
struct EncoderDelay {
  static constexpr std::string_view id = "encoder_delay";
  static constexpr Place place = Place::sensor;
  static constexpr std::string_view cause = "the encoder's interface, or a filter after it, delays the angle";
  static constexpr std::string_view law = "a sample at t sees theta_g(t - delay), before the start the angle there";
  T time{};

  static constexpr auto fields() {
    return std::tuple{
        Field{&EncoderDelay::time, "delay", unit::second, bounds::not_negative, "age of the angle that a sample sees"}};
  }
  /// Age of the measured angle [s].
  T measuring_delay() const { return time; }
};

}  // namespace wormdrive
