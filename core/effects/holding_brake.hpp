#pragma once
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/numbers/series.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// A brake on the worm's shaft, which rubs while it is closed. Whether it is belongs to the piece of time that holds.
template <class T>
struct HoldingBrake {
  static constexpr std::string_view id = "holding_brake";
  static constexpr Place place = Place::worm_shaft;
  static constexpr std::string_view cause = "a brake on the motor shaft holds it whenever the brake has no current";
  static constexpr std::string_view law = "-torque sgn(theta_w') while it is closed; at rest it holds up to torque";
  T torque{};
  std::optional<T> opens{}, closes{};
  bool closed = true;

  static constexpr auto fields() {
    using P = HoldingBrake;
    constexpr Presence o = Presence::optional;
    return std::tuple{
        Field{&P::torque, "torque", unit::newton_metre, bounds::not_negative, "friction torque while it is closed"},
        Field{&P::opens, "opens", unit::second, bounds::any,
              "time from which it is open; without both times it stays closed", o},
        Field{&P::closes, "closes", unit::second, bounds::any, "time from which it is closed", o}};
  }

  /// Takes the piece of time that holds from t on.
  void enter(double t) { closed = is_closed(t); }
  /// First time after t at which it opens or closes.
  double next_knot(double t) const {
    double next = never;
    for (const auto& time : {opens, closes})
      if (time && value_of(*time) > t && value_of(*time) < next) next = value_of(*time);
    return next;
  }
  /// Torque that holds now [N m].
  T braking() const { return closed ? torque : T(0.0); }
  /// Torque on the worm shaft [N m], by a moment that may say itself what holds.
  template <class S, template <class> class M>
  S worm_torque(const M<S>& at, Motion motion) const {
    if constexpr (requires { at.brake; })
      return T(-sign(motion)) * at.brake;
    else
      return S(-sign(motion) * braking());
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();

  bool is_closed(double t) const {
    if (!opens && !closes) return true;
    const double open = opens ? value_of(*opens) : -never, close = closes ? value_of(*closes) : never;
    return open <= close ? t < open || t >= close : t >= close && t < open;
  }
};

}  // namespace wormdrive
