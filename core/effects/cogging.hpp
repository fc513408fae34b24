#pragma once
#include <cmath>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/numbers/portable.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// The motor's rotor prefers some angles: a torque amplitude sin(periods theta_w + phase), which has a potential.
template <class T>
struct Cogging {
  static constexpr std::string_view id = "cogging";
  static constexpr Place place = Place::actuator;
  static constexpr std::string_view cause = "the magnets of the motor prefer some angles of its iron";
  static constexpr std::string_view law = "tau_m = u + amplitude sin(periods theta_w + phase)";
  T amplitude{};
  T periods{};
  T phase{};

  static constexpr auto fields() {
    return std::tuple{
        Field{&Cogging::amplitude, "amplitude", unit::newton_metre, bounds::any, "largest cogging torque"},
        Field{&Cogging::periods, "periods", unit::none, bounds::positive, "periods per turn of the worm"},
        Field{&Cogging::phase, "phase", unit::degrees, bounds::any, "phase at worm angle zero"}};
  }
  double ripple(double i) const { return amplitude != T(0) ? i * value_of(periods) : 0.0; }
  /// Motor torque [N m] for a command.
  template <class S>
  S motor_torque(const S& command, const Moment<S>& at) const {
    using portable::sin;
    return command + amplitude * sin(periods * at.theta_w + phase);
  }
};

}  // namespace wormdrive
