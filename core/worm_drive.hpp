#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <type_traits>

#include <Eigen/Core>

#include "core/numbers/rounded.hpp"
#include "core/numbers/series.hpp"
#include "core/states/impact_on_stop.hpp"
#include "core/states/jacobian.hpp"
#include "core/states/observe.hpp"
#include "core/states/state_rates.hpp"
#include "core/torque_balance.hpp"

namespace wormdrive {

/// The rigid worm drive as a hybrid system: in every mode its torque balance, between modes guards and a jump.
/// With states it carries those of its effects, which go on at rest: rest is then a mode to integrate as well.
template <class T, class Load, bool with_states = false>
class WormDrive : public TorqueBalance<T, Load> {
  using Balance = TorqueBalance<T, Load>;

 public:
  using Balance::acceleration, Balance::beyond_surface, Balance::effects, Balance::fastest_input, Balance::inputs,
      Balance::Jg, Balance::mesh, Balance::moment, Balance::motor_command, Balance::normal_force, Balance::side_torques,
      Balance::signed_friction, Balance::surface;
  template <class S>
  using SideTorques = typename Balance::template SideTorques<S>;

  static constexpr int shaft_count = 1;
  static constexpr int state_size = 2 + (with_states ? int{effect_state_count} : 0);
  using State = Eigen::Matrix<T, state_size, 1>;              ///< theta_g [rad], theta_g' [rad/s], those of the effects
  using Jacobian = Eigen::Matrix<T, state_size, state_size>;  ///< of the derivative to the state
  using Mode = wormdrive::Mode;
  template <class S>
  using MomentHere = std::conditional_t<with_states, MomentOfEffects<S>, Moment<S>>;
  static constexpr int guard_count = with_states ? 3 : 2;
  static constexpr int speed_guard = 0, flank_guard = 1, stop_guard = 2;  ///< while moving
  static constexpr int forward_guard = 0, backward_guard = 1;             ///< while stuck

  /// Time [s], state and mode: all that changes while a drive runs.
  struct Instant {
    double t{};
    State x = State::Zero();
    Mode mode{};
    T since{};  ///< when the gear came to rest, if it is at rest
  };

  using Balance::Balance;

  // ---- continuous motion --------------------------------------------------------------------------------------

  [[gnu::always_inline]] MomentHere<T> moment(const Instant& now) const {
    return resting(moment_at(T(now.t), now.x), now);
  }

  /// The same of any time and state, whatever their scalar.
  template <class S, class X>
  [[gnu::always_inline]] MomentHere<S> moment_at(const S& t, const X& x) const {
    if constexpr (with_states) {
      MomentHere<S> at{Balance::moment(t, S(x[0]), S(x[1])), {}};
      for (std::size_t k = 0; k < at.states.size(); ++k) at.states[k] = S(x[2 + k]);
      return at;
    } else {
      return Balance::moment(t, S(x[0]), S(x[1]));
    }
  }

  State derivative(double t, const State& x, Mode mode) const {
    const MomentHere<T> at = moment_at(T(t), x);
    State rate;
    rate[0] = mode.motion == Motion::stuck ? T(0) : x[1];
    rate[1] = acceleration(at, mode);
    if constexpr (with_states) {
      const auto of_effects = state_rates(at, mode);
      std::copy(of_effects.begin(), of_effects.end(), rate.data() + 2);
    }
    return rate;
  }
  /// Rates of the states of effects. M is a moment with these.
  template <class S, template <class> class M>
  auto state_rates(const M<S>& at, Mode mode) const {
    return wormdrive::state_rates(effects(), this->command_at(at), mesh(), this->load_at(at), at, mode.motion,
                                  [&] { return this->friction_loss(at, mode); });
  }
  Jacobian jacobian(double t, const State& x, Mode mode) const requires std::same_as<T, double> {
    return state_jacobian(*this, t, x, mode);
  }

  /// Time, angle, speed and the states of effects along the motion in the present mode, as power series to order N;
  /// with Rounded for a scalar every coefficient knows its rounding.
  template <int N, class C = T>
  MomentHere<Series<C, N>> ahead(const Instant& now) const {
    return along<Series<C, N>>(now, N);
  }
  /// The same to any order up to highest_series.
  MomentHere<OpenSeries<T>> ahead(const Instant& now, int order) const { return along<OpenSeries<T>>(now, order); }

  /// The state at a moment, in the order of State.
  template <class S, template <class> class M>
  static std::array<S, state_size> state_at(const M<S>& at) {
    std::array<S, state_size> state{at.theta_g, at.omega_g};
    if constexpr (with_states) std::copy(at.states.begin(), at.states.end(), state.begin() + 2);
    return state;
  }

  // ---- events -------------------------------------------------------------------------------------------------

  /// Whether nothing changes but the inputs.
  static bool at_rest(Mode mode) { return !with_states && mode.motion == Motion::stuck; }
  /// Whether the gear moves and has no speed yet.
  static bool leaves_rest(const Instant& now) { return now.mode.motion != Motion::stuck && now.x[1] == T(0); }

  /// Lets the speed be as the mode has it: rounding leaves it on either side of zero at a reversal.
  static void keep_within_mode(Instant& now) {
    if (T(sign(now.mode.motion)) * now.x[1] < T(0)) now.x[1] = T(0);
  }

  /// Functions that are positive while the mode holds and fall through zero when it ends: while moving the speed, the
  /// distance to the switching surface and the way to a stop, while stuck the margins to break-in, in rad/s^2.
  template <class S, template <class> class M>
  std::array<S, guard_count> guards(const M<S>& at, Mode mode) const {
    std::array<S, guard_count> all;
    if (mode.motion == Motion::stuck) {
      all[forward_guard] = margin(at, Motion::forward);
      all[backward_guard] = margin(at, Motion::backward);
    } else {
      all[speed_guard] = T(sign(mode.motion)) * at.omega_g;
      all[flank_guard] =
          mode.flank == Flank::none ? S(T(1)) : S(-T(sign(mode.flank)) * beyond_surface(at, mode.motion));
    }
    if constexpr (with_states) all[stop_guard] = way_to_stop(effects(), at.theta_g, mode.motion);
    return all;
  }

  /// Sizes of the terms of which the guards of a moving drive are the sums: what their rounding is a share of.
  std::array<double, guard_count> guard_terms(const MomentHere<double>& at,
                                              Mode mode) const requires std::same_as<T, double> {
    const SideTorques<double> tau = side_torques(at, mode.motion);
    std::array<double, guard_count> terms{std::abs(at.omega_g),
                                          std::abs(tau.worm) + std::abs(tau.worm - beyond_surface(tau, at))};
    if constexpr (with_states)
      terms[stop_guard] = std::abs(at.theta_g) + std::abs(way_to_stop(effects(), at.theta_g, mode.motion));
    return terms;
  }

  /// Values and rates of the guards along the motion.
  std::array<Series<T, 1>, guard_count> guards_ahead(const Instant& now) const {
    if constexpr (with_states) return guards(ahead<1>(now), now.mode);
    Series<T, 1> theta_g(now.x[0]), omega_g(now.x[1]);
    theta_g[1] = now.x[1];
    omega_g[1] = acceleration(moment(now), now.mode);
    return guards(resting(moment(Series<T, 1>::variable(T(now.t)), theta_g, omega_g), now), now.mode);
  }

  static std::string_view guard_name(Mode mode, int guard) {
    if (guard == stop_guard) return "hard stop";
    if (mode.motion == Motion::stuck) return guard == forward_guard ? "forward break-in" : "backward break-in";
    return guard == speed_guard ? "gear speed" : "switching surface";
  }

  /// The state after a guard has fired. The crossing itself is trusted: its condition is not tested again.
  Instant jump(Instant now, int guard) const {
    if (now.mode.motion == Motion::stuck) {
      now.mode = moving(now, guard == forward_guard ? Motion::forward : Motion::backward);
    } else if (guard != flank_guard) {
      const Motion reversed = now.mode.motion == Motion::forward ? Motion::backward : Motion::forward;
      if constexpr (with_states) guard == stop_guard ? strike(*this, now) : keep_between_stops(effects(), now.x[0]);
      if (guard == speed_guard) now.x[1] = T(0);
      now.since = T(now.t);
      now.mode = now.x[1] != T(0) || starts(now, reversed) ? moving(now, reversed) : Mode{};
    } else {
      // the other one, unless the surface is only touched
      const auto beyond = beyond_surface(ahead<deciding, Rounded>(now), now.mode.motion);
      now.mode.flank = flank_just_after(beyond, now.t, across_surface(now.mode).flank);
    }
    return now;
  }
  /// The same where it is known already that the switching surface is crossed and not only touched.
  static Mode across_surface(Mode mode) {
    return {mode.motion, mode.flank == Flank::left ? Flank::right : Flank::left};
  }

  /// The flank that carries at a distance beyond_surface(tau, at) far from the surface; nothing where it is not far.
  std::optional<Flank> flank_by_far(const SideTorques<T>& tau, const T& distance) const {
    using std::abs;
    // no input or drive moves a torque by a thousandth within the resolution of time, and rounding is far below it
    const bool far = abs(distance) > T(1e-3) * (abs(tau.worm) + abs(surface() * tau.gear));
    return far || !mesh().has_teeth ? std::optional(flank_at(distance)) : std::nullopt;
  }

  /// The mode in which the drive goes on after inputs or state were set from outside; ties mean stick.
  Mode settle(const Instant& now) const {
    if (now.x[1] != T(0)) return moving(now, now.x[1] > T(0) ? Motion::forward : Motion::backward);
    for (const Motion motion : {Motion::forward, Motion::backward})
      if (starts(now, motion)) return moving(now, motion);
    return {};
  }

  /// The gear angle that the sensor sees [rad].
  T measured_angle(const Instant& now) const { return effects().measured_angle(now.x[0]); }

  Observation observe(const Instant& now) const requires std::same_as<T, double> { return observation(*this, now); }

 private:
  template <class Flow>
  MomentHere<Flow> along(const Instant& now, int order) const {
    using C = ConstantOf<Flow>;
    MomentHere<Flow> at = moment_at(Flow::variable(C(now.t), 1), now.x);
    const int last = at.t.within(order);
    const auto extend = [&](int k, const auto& known, const auto& coefficient) {
      const auto over = [k](const C& x) { return k == 0 ? x : x / C(k + 1); };
      const auto a = acceleration(known, now.mode);
      if constexpr (with_states) {
        const auto rates = state_rates(known, now.mode);
        for (std::size_t j = 0; j < rates.size(); ++j) at.states[j].append(k + 1, over(coefficient(rates[j])));
      }
      at.t.know(k + 1);
      at.theta_g.append(k + 1, over(at.omega_g[k]));
      at.omega_g.append(k + 1, over(coefficient(a)));
      this->turn_worm(at);
    };
    if (last > 0) extend(0, resting(moment_at(C(now.t), now.x), now), [](const C& x) { return x; });
    for (int k = 1; k < last; ++k) extend(k, at, [k](const Flow& x) { return x[k]; });
    return resting(at, now);
  }

  static constexpr int deciding = 3;  ///< order of the series that decide what happens just after an event

  /// Whether a stop holds the gear in a direction.
  template <class S>
  bool is_held([[maybe_unused]] const S& theta_g, [[maybe_unused]] Motion motion) const {
    if constexpr (with_states)
      return is_at_stop(effects(), theta_g, motion);
    else
      return false;
  }
  /// What is left to break-in in a direction [rad/s^2].
  template <class S, template <class> class M>
  S margin(const M<S>& at, Motion motion) const {
    return is_held(at.theta_g, motion) ? S(T(1)) : S(T(-sign(motion)) * release_acceleration(at, motion));
  }
  /// The acceleration that motion from rest would have, on the flank that this motion would load.
  template <class S, template <class> class M>
  S release_acceleration(const M<S>& at, Motion motion) const {
    return acceleration(at, Mode{motion, flank_at(beyond_surface(at, motion))});
  }
  template <class S>
  Flank flank_at(const S& beyond) const {
    return !mesh().has_teeth ? Flank::none : is_positive(beyond) ? Flank::right : Flank::left;
  }
  /// On the surface itself, the flank just after.
  template <int N>
  Flank flank_at(const Series<Rounded, N>& beyond) const {
    return !mesh().has_teeth ? Flank::none : sign_just_after(beyond, 0.0) > 0 ? Flank::right : Flank::left;
  }

  /// Whether the gear starts from rest in this direction. An acceleration that is not more than what is not known of it
  /// starts nothing: ties mean stick, and the guard of rest finds the moment at which they end.
  bool starts(const Instant& now, Motion motion) const {
    if (is_held(now.x[0], motion)) return false;
    Instant rest{now.t, now.x, {}, now.since};
    rest.x[1] = T(0);
    if (T(sign(motion)) * release_acceleration(moment(rest), motion) <= T(0)) return false;  // mostly, at less cost
    const Series<Rounded, 1> a = release_acceleration(ahead<1, Rounded>(rest), motion);
    return sign(motion) * a[0].value > blur(a, 0, time_resolution(now.t));
  }

  /// The moving mode just after now: flank by the first derivative of the surface distance that does not vanish.
  Mode moving(const Instant& now, Motion motion) const {
    if (!mesh().has_teeth) return {motion, Flank::none};
    const MomentHere<T> at = moment(now);
    const SideTorques<T> tau = side_torques(at, motion);
    const T distance = beyond_surface(tau, at);
    if (const auto flank = flank_by_far(tau, distance)) return {motion, *flank};
    const Instant then{now.t, now.x, {motion, flank_at(distance)}, now.since};
    return {motion, flank_just_after(beyond_surface(ahead<deciding, Rounded>(then), motion), now.t, Flank::left)};
  }

  /// The flank that carries the load just after t; the other argument where nothing decides.
  static Flank flank_just_after(const Series<Rounded, deciding>& beyond, double t, Flank undecided) {
    const int side = sign_just_after(beyond, time_resolution(t));
    return side == 0 ? undecided : side > 0 ? Flank::right : Flank::left;
  }
};

template <class T, class Load>
WormDrive(GearMesh<T>, Load, Effects<T>, Signal) -> WormDrive<T, Load>;

}  // namespace wormdrive
