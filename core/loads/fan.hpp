#pragma once
#include <limits>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/mode.hpp"
#include "core/moment.hpp"

namespace wormdrive {

/// A fan, a pump or a stirrer on the gear shaft: tau_l = -torque (theta_g'/speed)^2 against the motion.
struct Fan {
  static constexpr std::string_view kind = "fan";
  static constexpr std::string_view meaning =
      "fan, pump or stirrer: torque (gear speed / speed)^2 against the motion, square law";
  double rated_torque{};    ///< [N m]
  double rated_speed{};     ///< [rad/s]
  double own_inertia{0.0};  ///< [kg m^2]

  static constexpr auto fields() {
    using P = Fan;
    return std::tuple{
        Field{&P::rated_torque, "torque", unit::newton_metre, bounds::not_negative, "torque at the speed"},
        Field{&P::rated_speed, "speed", unit::radian_per_second, bounds::positive, "gear speed at which it is stated"},
        Field{&P::own_inertia, "inertia", unit::kilogram_square_metre, bounds::not_negative,
              "the load's own inertia about the gear's axis", Presence::optional}};
  }

  double inertia() const { return own_inertia; }
  void enter(double) {}
  double next_knot(double) const { return std::numeric_limits<double>::infinity(); }
  double fastest() const { return 0.0; }
  double ripple() const { return 0.0; }

  /// Load torque tau_l [N m] while the gear moves in a direction; 0 at rest. The direction is no sign of the speed, so
  /// that the torque is smooth where an integrator looks beyond a reversal.
  template <class S>
  S torque(const Moment<S>& at, Motion motion) const {
    return -sign(motion) * rated_torque / (rated_speed * rated_speed) * (at.omega_g * at.omega_g);
  }
};

}  // namespace wormdrive
