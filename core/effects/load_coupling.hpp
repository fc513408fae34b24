#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/numbers/crossing.hpp"
#include "core/numbers/jet.hpp"
#include "core/numbers/series.hpp"
#include "core/place.hpp"
#include "core/states/effect_states.hpp"

namespace wormdrive {

/// The load hangs on the gear by a coupling, with an inertia of its own behind it. With a stiffness the coupling
/// twists: by how much the load is ahead of the gear, and its speed, are states, and the loads act on the inertia
/// behind the coupling. A coupling that does not twist makes the gear heavier.
template <class T>
struct LoadCoupling {
  static constexpr std::string_view id = "load_coupling";
  static constexpr Place place = Place::load;
  static constexpr std::string_view cause =
      "a shaft, a belt or an arm between gear and load twists, and the load swings behind it";
  static constexpr std::string_view law =
      "stiffness x + damping x' on the gear, where the load turns at theta_g + x by (inertia + that of the load) "
      "(theta_g + x)'' = tau_l - stiffness x - damping x'; x = 0 without stiffness";
  T inertia{};
  std::optional<T> stiffness{};
  std::optional<T> damping{};

  static constexpr auto fields() {
    using P = LoadCoupling;
    constexpr Presence o = Presence::optional;
    return std::tuple{Field{&P::inertia, "inertia", unit::kilogram_square_metre, bounds::positive,
                            "of what turns behind the coupling, in addition to that of the load itself"},
                      Field{&P::stiffness, "stiffness", unit::newton_metre_per_radian, bounds::positive,
                            "of the coupling; if not stated it is rigid", o},
                      Field{&P::damping, "damping", unit::newton_metre_second_per_radian, bounds::not_negative,
                            "of the coupling; 0 if not stated", o}};
  }

  // ---- its states ---------------------------------------------------------------------------------------------

  static constexpr std::array states{EffectState{"twist", unit::radian, "by how much the load is ahead of the gear"},
                                     EffectState{"speed", unit::radian_per_second, "speed of the load"}};
  static constexpr std::string_view without_states = "leave its stiffness out";
  bool has_state(std::size_t) const { return stiffness.has_value(); }
  /// Where the load is, and how fast it turns.
  template <class S>
  Moment<S> at_load(Moment<S> at, const std::array<S, 2>& state) const {
    at.theta_g = at.theta_g + state[0];
    at.omega_g = state[1];
    return at;
  }
  /// x' [rad/s] and the acceleration of the load [rad/s^2] under its torque [N m], with its own inertia [kg m^2].
  template <class S>
  std::array<S, 2> state_rates(const S& tau_l, const S& own_inertia, const Moment<S>& at,
                               const std::array<S, 2>& state) const {
    return {S(state[1] - at.omega_g), S((tau_l - torque_on_gear(at, state)) / (inertia + own_inertia))};
  }
  /// The states in which the coupling carries the load and both turn as one, with the least twist that does. tau_l(x):
  /// of the load where it is x ahead of the gear [N m], with so many periods per radian, 0 for none. Relaxed where no
  /// twist carries it, as under a spring that pushes further than the coupling pulls.
  template <class Torque>
  std::array<T, 2> start(const Moment<T>& at, const Torque& tau_l, double ripple) const {
    const auto missing = [&](double x) { return value_of(T(*stiffness * T(x) - tau_l(T(x)))); };
    const double relaxed = missing(0.0);
    double before = 0.0, x = -relaxed / value_of(*stiffness);
    if (ripple > 0.0 && std::abs(x) > 0.1 / ripple) {  // in looks between which a torque does not come and go
      const double look = std::copysign(0.1 / ripple, x);
      constexpr int looks = 1'000'000;
      int k = 1;
      while (k < looks && relaxed * missing(k * look) > 0.0) ++k;
      before = (k - 1) * look;
      x = k * look;
    }
    constexpr int doublings = 60;  // a torque that grows more slowly than its angle is met before
    for (int k = 0; k < doublings && relaxed * missing(x) > 0.0; ++k) x = 2.0 * x;
    const bool carries = relaxed * missing(x) < 0.0 || missing(x) == 0.0;
    if (!carries) before = x = 0.0;
    const auto [low, high] = std::minmax({before, x});
    const double twist = root_between(FunctionView<double>(missing), low, missing(low), high, missing(high));
    if constexpr (std::is_same_v<T, double>) {
      return {twist, at.omega_g};
    } else {  // a step of Newton has the derivatives
      if (!carries) return {T(twist), at.omega_g};
      using Ahead = Series<T, 1>;
      const Ahead ahead = Ahead::variable(T(twist));
      const Ahead left = *stiffness * ahead - tau_l(ahead);
      return {T(twist) - (left[0] - T(value_of(left[0]))) / T(value_of(left[1])), at.omega_g};
    }
  }

  // ---- what it does -------------------------------------------------------------------------------------------

  /// [N m]
  template <class S>
  S torque_on_gear(const Moment<S>& at, const std::array<S, 2>& state) const {
    const S spring = *stiffness * state[0];
    return damping ? S(spring + *damping * (state[1] - at.omega_g)) : spring;
  }
  /// Inertia on the gear shaft [kg m^2].
  T gear_inertia() const { return stiffness ? T(0) : inertia; }
};

}  // namespace wormdrive
