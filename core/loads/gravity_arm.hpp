#pragma once
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/numbers/portable.hpp"

namespace wormdrive {

/// Standard acceleration of gravity as the paper uses it [m/s^2]: its loads 0.69 and 1.37 N m are m g d with 9.81.
inline constexpr double gravity = 9.81;

/// A mass on an arm, stated by its torque amplitude or by mass and arm: tau_l = m g d cos(theta_g + offset).
struct GravityArm {
  static constexpr std::string_view kind = "gravity_arm";
  static constexpr std::string_view meaning =
      "mass on an arm, torque cos(theta_g + angle_offset); state torque, or mass and arm";
  std::optional<double> amplitude;    ///< [N m]
  std::optional<double> mass;         ///< [kg]
  std::optional<double> arm;          ///< [m]
  double offset{0.0};                 ///< [rad]
  std::optional<double> own_inertia;  ///< [kg m^2]

  static constexpr auto fields() {
    using P = GravityArm;
    return std::tuple{
        Field{&P::amplitude, "torque", unit::newton_metre, bounds::any,
              "torque with the arm horizontal, instead of mass and arm", Presence::optional},
        Field{&P::mass, "mass", unit::kilogram, bounds::not_negative, "mass on the arm", Presence::optional},
        Field{&P::arm, "arm", unit::metre, bounds::any, "distance of the mass from the gear's axis",
              Presence::optional},
        Field{&P::offset, "angle_offset", unit::degrees, bounds::any,
              "angle of the arm at theta_g = 0, from horizontal on in the sense of forward", Presence::optional},
        Field{&P::own_inertia, "inertia", unit::kilogram_square_metre, bounds::not_negative,
              "the load's own inertia about the gear's axis; mass arm^2 if mass and arm are stated, else 0",
              Presence::optional}};
  }

  double torque_amplitude() const { return amplitude ? *amplitude : *mass * gravity * *arm; }
  double inertia() const {
    if (own_inertia) return *own_inertia;
    return mass && arm ? *mass * *arm * *arm : 0.0;
  }
};

/// The gravity load as the equations use it.
struct GravityLoad {
  double amplitude;  ///< [N m]
  double offset;     ///< [rad]
  double J;          ///< [kg m^2]

  explicit GravityLoad(const GravityArm& arm)
      : amplitude(arm.torque_amplitude()), offset(arm.offset), J(arm.inertia()) {}

  double inertia() const { return J; }
  void enter(double) {}
  double next_knot(double) const { return std::numeric_limits<double>::infinity(); }
  double fastest() const { return 0.0; }
  double ripple() const { return amplitude != 0.0 ? 1.0 : 0.0; }

  /// Load torque tau_l [N m] = amplitude cos(theta_g + offset).
  template <class S>
  S torque(const Moment<S>& at) const {
    using portable::cos;
    return amplitude * cos(at.theta_g + offset);
  }
};

}  // namespace wormdrive
