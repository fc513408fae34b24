#pragma once
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"

namespace wormdrive {

/// Elastic stops at one or both ends of the way, which push only: stiffness d (1 + damping d') at a penetration d, and
/// nothing where that would pull.
struct EndStops {
  static constexpr std::string_view kind = "end_stops";
  static constexpr std::string_view meaning =
      "elastic stops beyond a lowest and a highest angle, which push only; state either or both";
  std::optional<double> low;   ///< [rad]
  std::optional<double> high;  ///< [rad]
  double stiffness{};          ///< [N m/rad]
  double damping{0.0};         ///< [s/rad]

  static constexpr auto fields() {
    using P = EndStops;
    return std::tuple{
        Field{&P::low, "angle_low", unit::degrees, bounds::any, "gear angle below which one stop pushes",
              Presence::optional},
        Field{&P::high, "angle_high", unit::degrees, bounds::any, "gear angle above which the other one pushes",
              Presence::optional},
        Field{&P::stiffness, "stiffness", unit::newton_metre_per_radian, bounds::positive,
              "torque per angle of penetration"},
        Field{&P::damping, "damping", unit::second_per_radian, bounds::not_negative,
              "law of Hunt and Crossley: share of the elastic torque that damping adds per speed", Presence::optional}};
  }

  double inertia() const { return 0.0; }
  void enter(double) {}
  double next_knot(double) const { return std::numeric_limits<double>::infinity(); }
  double fastest() const { return 0.0; }
  double ripple() const { return 0.0; }

  /// Load torque tau_l [N m]. It bends where a stop is met and does not jump.
  template <class S>
  S torque(const Moment<S>& at) const {
    S torque(0.0);
    if (low) torque = torque + push(S(*low) - at.theta_g, -at.omega_g);
    if (high) torque = torque - push(at.theta_g - S(*high), at.omega_g);
    return torque;
  }

 private:
  template <class S>
  S push(const S& depth, const S& rate) const {
    const S nothing(0.0), force = stiffness * (depth + depth * (damping * rate));
    return depth > nothing && force > nothing ? force : nothing;
  }
};

}  // namespace wormdrive
