#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <Eigen/Core>
#include <ceres/jet.h>

#include "core/observation.hpp"
#include "core/series.hpp"
#include "core/torque_balance.hpp"

namespace wormdrive {

/// The rigid worm drive as a hybrid system: in every mode its torque balance, between modes guards and a jump.
template <class T, class Load>
class WormDrive : public TorqueBalance<T, Load> {
  using Balance = TorqueBalance<T, Load>;

 public:
  using Balance::acceleration, Balance::beyond_surface, Balance::effects, Balance::fastest_input, Balance::inputs,
      Balance::Jg, Balance::mesh, Balance::moment, Balance::side_torques, Balance::signed_friction, Balance::surface;
  template <class S>
  using SideTorques = typename Balance::template SideTorques<S>;

  static constexpr int state_size = 2;
  using State = Eigen::Matrix<T, 2, 1>;     ///< theta_g [rad], theta_g' [rad/s]
  using Jacobian = Eigen::Matrix<T, 2, 2>;  ///< d(theta_g', theta_g'')/d(theta_g, theta_g')
  using Mode = wormdrive::Mode;

  static constexpr int guard_count = 2;
  static constexpr int speed_guard = 0, flank_guard = 1;       ///< while moving
  static constexpr int forward_guard = 0, backward_guard = 1;  ///< while stuck

  /// Time [s], state and mode: all that changes while a drive runs.
  struct Instant {
    double t{};
    State x = State::Zero();
    Mode mode{};
    T since{};  ///< when the gear came to rest, if it is at rest
  };

  using Balance::Balance;

  // ---- continuous motion --------------------------------------------------------------------------------------

  [[gnu::always_inline]] Moment<T> moment(const Instant& now) const {
    return resting(moment(T(now.t), now.x[0], now.x[1]), now);
  }

  State derivative(double t, const State& x, Mode mode) const {
    return {mode.motion == Motion::stuck ? T(0) : x[1], acceleration(moment(T(t), x[0], x[1]), mode)};
  }

  /// Exact Jacobian of the derivative, by automatic differentiation: it stays right whatever effects are on.
  Jacobian jacobian(double t, const State& x, Mode mode) const requires std::same_as<T, double> {
    using Jet = ceres::Jet<double, 2>;
    const Jet a = acceleration(moment(Jet(t), Jet(x[0], 0), Jet(x[1], 1)), mode);
    if (mode.motion == Motion::stuck) return Jacobian::Zero();
    return (Jacobian() << 0.0, 1.0, a.v[0], a.v[1]).finished();
  }

  /// Time, angle and speed along the motion in the present mode, as power series to order N.
  template <int N>
  Moment<Series<T, N>> ahead(const Instant& now) const {
    using Flow = Series<T, N>;
    Moment<Flow> at = moment(Flow::variable(T(now.t)), Flow(now.x[0]), Flow(now.x[1]));
    at.theta_g[1] = now.x[1];
    at.omega_g[1] = acceleration(moment(now), now.mode);
    for (int k = 1;; ++k) {
      this->turn_worm(at);
      if (k == N) return resting(at, now);
      const Flow a = acceleration(at, now.mode);
      at.theta_g[k + 1] = at.omega_g[k] / T(k + 1);
      at.omega_g[k + 1] = a[k] / T(k + 1);
    }
  }

  // ---- events -------------------------------------------------------------------------------------------------

  /// Events closer than this are one event [s]. Where an input only touches a boundary, rounding places the event no
  /// better than the square root of epsilon in its period; still far below anything mechanical.
  double instant() const { return fastest_input() > 0.0 ? std::max(1e-11, 1e-7 / fastest_input()) : 1e-11; }

  static bool at_rest(Mode mode) { return mode.motion == Motion::stuck; }

  /// Functions that are positive while the mode holds and fall through zero when it ends: while moving the speed in
  /// its direction and the distance to the switching surface, while stuck the margins to break-in, in rad/s^2.
  template <class S>
  std::array<S, guard_count> guards(const Moment<S>& at, Mode mode) const {
    if (mode.motion == Motion::stuck)
      return {-release_acceleration(at, Motion::forward), release_acceleration(at, Motion::backward)};
    const S speed = T(sign(mode.motion)) * at.omega_g;
    if (mode.flank == Flank::none) return {speed, S(T(1))};
    return {speed, -T(sign(mode.flank)) * beyond_surface(at, mode.motion)};
  }

  /// Sizes of the terms of which the guards of a moving drive are the sums: what their rounding is a share of.
  std::array<double, guard_count> guard_terms(const Moment<double>& at,
                                              Mode mode) const requires std::same_as<T, double> {
    const SideTorques<double> tau = side_torques(at, mode.motion);
    return {std::abs(at.omega_g), std::abs(tau.worm) + std::abs(tau.worm - beyond_surface(tau, at))};
  }

  /// Values and rates of the guards along the motion.
  std::array<Series<T, 1>, guard_count> guards_ahead(const Instant& now) const {
    // what ahead<1> finds, without the rate of the acceleration, which would be thrown away
    Series<T, 1> theta_g(now.x[0]), omega_g(now.x[1]);
    theta_g[1] = now.x[1];
    omega_g[1] = acceleration(moment(now), now.mode);
    return guards(resting(moment(Series<T, 1>::variable(T(now.t)), theta_g, omega_g), now), now.mode);
  }

  static std::string_view guard_name(Mode mode, int guard) {
    if (mode.motion == Motion::stuck) return guard == forward_guard ? "forward break-in" : "backward break-in";
    return guard == speed_guard ? "gear speed" : "switching surface";
  }

  /// The state after a guard has fired. The crossing itself is trusted: its condition is not tested again.
  Instant jump(Instant now, int guard) const {
    if (now.mode.motion == Motion::stuck) {
      now.mode = moving(now, guard == forward_guard ? Motion::forward : Motion::backward);
    } else if (guard == speed_guard) {
      now.x[1] = T(0);
      now.since = T(now.t);
      const Motion reversed = now.mode.motion == Motion::forward ? Motion::backward : Motion::forward;
      now.mode = starts(now, reversed) ? moving(now, reversed) : Mode{};
    } else {
      now.mode.flank = flank_after_crossing(now);
    }
    return now;
  }
  /// The same where it is known already that the switching surface is crossed and not only touched.
  static Mode across_surface(Mode mode) {
    return {mode.motion, mode.flank == Flank::left ? Flank::right : Flank::left};
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

  // ---- what is reported ---------------------------------------------------------------------------------------

  Observation observe(const Instant& now) const requires std::same_as<T, double> {
    const Moment<double> at = moment(now);
    const SideTorques<double> input = inputs(at), tau = side_torques(input, at, now.mode.motion);
    const double alpha = now.mode.motion == Motion::stuck ? 0.0 : acceleration(tau, at, now.mode);
    return {.theta_g = now.x[0],
            .omega_g = now.x[1],
            .alpha_g = alpha,
            .tau_m = input.worm,
            .tau_l = input.gear,
            .normal_force = mesh().normal_force(this->along_gear(tau.worm, at), tau.gear, Jg() * alpha, now.mode,
                                                signed_friction(at, now.mode)),
            .mode = now.mode};
  }

 private:
  template <class S>
  static Moment<S> resting(Moment<S> at, const Instant& now) {
    if (now.mode.motion == Motion::stuck) at.rest = at.t - S(now.since);
    return at;
  }
  /// Whether a balance of torques [N m] keeps its sign for an instant, none of them changing by its size within 10 us.
  bool lasts(const T& balance, const SideTorques<T>& tau) const {
    using std::abs;
    return abs(balance) > T(1e5 * instant()) * (abs(tau.worm) + abs(surface() * tau.gear));
  }
  static constexpr int order = 3;  ///< of the series that decide what happens just after an event

  /// The acceleration that motion from rest would have, on the flank that this motion would load.
  template <class S>
  S release_acceleration(const Moment<S>& at, Motion motion) const {
    return acceleration(at, Mode{motion, flank_at(beyond_surface(at, motion))});
  }
  template <class S>
  Flank flank_at(const S& beyond) const {
    if (!mesh().has_teeth) return Flank::none;
    return beyond <= S(T(0)) ? Flank::left : Flank::right;
  }

  /// Whether the gear starts from rest in this direction: by its acceleration now or, where that is zero, just after.
  bool starts(const Instant& now, Motion motion) const {
    const Instant rest{now.t, {now.x[0], T(0)}, {}, now.since};
    const T a_now = release_acceleration(moment(rest), motion);
    if (lasts(a_now * mesh().Jw * mesh().i, side_torques(moment(rest), motion)))
      return (a_now > T(0)) == (motion == Motion::forward);
    const auto a = release_acceleration(ahead<order>(rest), motion);
    return a[0] != T(0) && sign_just_after(a, instant()) == sign(motion);
  }

  /// The moving mode just after now: flank by the first derivative of the surface distance that does not vanish.
  Mode moving(const Instant& now, Motion motion) const {
    if (!mesh().has_teeth) return {motion, Flank::none};
    const Moment<T> at = moment(now);
    const SideTorques<T> tau = side_torques(at, motion);
    const T distance = beyond_surface(tau, at);
    const Flank now_on = flank_at(distance);
    if (lasts(distance, tau)) return {motion, now_on};
    const auto beyond = beyond_surface(ahead<order>({now.t, now.x, {motion, now_on}, now.since}), motion);
    return {motion, sign_just_after(beyond, instant()) > 0 ? Flank::right : Flank::left};
  }

  /// The flank behind a crossing of the switching surface: the other one, unless the surface is only touched.
  Flank flank_after_crossing(const Instant& now) const {
    using std::abs;
    const auto near = beyond_surface(ahead<2>(now), now.mode.motion);
    if (abs(near[1]) > T(2.0 * instant()) * abs(near[2])) return near[1] > T(0) ? Flank::right : Flank::left;
    auto beyond = beyond_surface(ahead<order>(now), now.mode.motion);
    beyond[0] = T(0);
    const int side = sign_just_after(beyond, instant());
    if (side == 0) return across_surface(now.mode).flank;
    return side > 0 ? Flank::right : Flank::left;
  }
};

template <class T, class Load>
WormDrive(GearMesh<T>, Load, Effects<T>, Signal) -> WormDrive<T, Load>;

}  // namespace wormdrive
