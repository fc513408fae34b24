#pragma once
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/numbers/series.hpp"

namespace wormdrive {

/// Elastic stops at one or both ends of the way, which push only: stiffness d (1 + damping d') at a penetration d, and
/// nothing where that would pull.
struct EndStops {
  static constexpr std::string_view kind = "end_stops";
  static constexpr std::string_view meaning =
      "elastic stops below a lowest and above a highest angle, which only push; state either or both";
  std::optional<double> low;   ///< [rad]
  std::optional<double> high;  ///< [rad]
  double stiffness{};          ///< [N m/rad]
  double damping{0.0};         ///< [s/rad]

  static constexpr auto fields() {
    using P = EndStops;
    return std::tuple{
        Field{&P::low, "angle_low", unit::degrees, bounds::any, "gear angle below which the lower stop pushes",
              Presence::optional},
        Field{&P::high, "angle_high", unit::degrees, bounds::any, "gear angle above which the upper stop pushes",
              Presence::optional},
        Field{&P::stiffness, "stiffness", unit::newton_metre_per_radian, bounds::positive, "torque per penetration"},
        Field{&P::damping, "damping", unit::second_per_radian, bounds::not_negative,
              "law of Hunt and Crossley: share of the elastic torque that damping adds per speed", Presence::optional}};
  }

  double inertia() const { return 0.0; }
  void enter(double) {}
  double next_knot(double) const { return std::numeric_limits<double>::infinity(); }
  double fastest() const { return 0.0; }
  double ripple() const { return 0.0; }

  /// Calls visit with every quantity at whose zero the torque bends: it does not jump where a stop is met or left.
  template <class S, class Visit>
  void for_each_bend(const Moment<S>& at, Visit&& visit) const {
    if (low) visit(S(at.theta_g - S(*low)));
    if (high) visit(S(at.theta_g - S(*high)));
    if (damping == 0.0) return;  // else it pulls where the shaft leaves faster than the stop follows
    if (low) visit(S(S(1.0) - damping * at.omega_g));
    if (high) visit(S(S(1.0) + damping * at.omega_g));
  }
  /// Load torque tau_l [N m].
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
    const S damped = damping * rate;
    const bool meets = is_positive(depth), follows = damping == 0.0 || is_positive(S(S(1.0) + damped));
    return only_where(meets && follows, S(stiffness * (depth + depth * damped)));
  }
};

}  // namespace wormdrive
