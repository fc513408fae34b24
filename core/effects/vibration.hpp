#pragma once
#include <numbers>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/numbers/jet.hpp"
#include "core/numbers/portable.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// Something beside the drive shakes the worm shaft: amplitude sin(2 pi frequency t + phase).
template <class T>
struct Vibration {
  static constexpr std::string_view id = "vibration";
  static constexpr Place place = Place::worm_shaft;
  static constexpr std::string_view cause = "a machine nearby, or the mains, shakes the drive";
  static constexpr std::string_view law = "amplitude sin(2 pi frequency t + phase), on the worm";
  T amplitude{};
  T frequency{};
  T phase{};

  static constexpr auto fields() {
    return std::tuple{
        Field{&Vibration::amplitude, "amplitude", unit::newton_metre, bounds::any, "largest torque on the worm"},
        Field{&Vibration::frequency, "frequency", unit::hertz, bounds::positive, "periods per second"},
        Field{&Vibration::phase, "phase", unit::degrees, bounds::any, "phase at t = 0"}};
  }
  double fastest_in_time() const { return 2.0 * std::numbers::pi * value_of(frequency); }
  /// Torque on the worm shaft [N m].
  template <class S>
  S worm_torque(const Moment<S>& at, Motion) const {
    using portable::sin;
    return amplitude * sin(T(2.0 * std::numbers::pi) * frequency * at.t + phase);
  }
};

}  // namespace wormdrive
