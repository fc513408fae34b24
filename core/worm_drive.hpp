#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <Eigen/Core>
#include <ceres/jet.h>

#include "core/effects.hpp"
#include "core/mesh.hpp"
#include "core/moment.hpp"
#include "core/motor_input.hpp"
#include "core/observation.hpp"
#include "core/series.hpp"

namespace wormdrive {

/// The rigid worm drive as a hybrid system: in every mode one linear equation [YehWu2009, eq. 18-19], between modes
/// guards and a jump. Inputs (motor torque and a load over time) are frozen to the smooth piece that holds now.
///
/// T is the scalar of the parameters, the scalar S of a moment may differ (derivatives along the motion).
template <class T, class Load>
class WormDrive {
 public:
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
  };

  WormDrive(GearMesh<T> mesh, Load load, Effects<T> effects, Signal motor)
      : mesh_(std::move(mesh)),
        load_(std::move(load)),
        effects_(std::move(effects)),
        motor_(std::move(motor), effects_.torque_limit()) {
    mesh_.Jw = mesh_.Jw + effects_.worm_inertia();
    mesh_.Jg = mesh_.Jg + effects_.gear_inertia();
    Jw_i_ = mesh_.Jw * mesh_.i;
    Jg_ = mesh_.Jg + load_.inertia();
    friction_changes_ = effects_.change_friction();
  }

  /// The mesh with the inertias that effects add; its friction is that without effects.
  const GearMesh<T>& mesh() const { return mesh_; }
  const Load& load() const { return load_; }
  const Effects<T>& effects() const { return effects_; }
  /// Inertia of the gear side with the load's own [kg m^2].
  T Jg() const { return Jg_; }
  /// Slope of the switching surface, Jw i / Jg [YehWu2009, eq. 17].
  T surface() const { return Jw_i_ / Jg_; }

  // ---- inputs -------------------------------------------------------------------------------------------------

  /// Freezes the inputs to the pieces that hold from t on.
  void enter(double t) {
    motor_.enter(t);
    load_.enter(t);
  }
  /// Holds a motor torque [N m] from t on, in addition to the motor's signal; the caller settles the mode.
  void command(double t, double tau_m) { motor_.command(t, tau_m); }
  /// The smooth piece of the motor's command that holds now [N m].
  const Piece& motor_piece() const { return motor_.piece(); }
  /// First time after t at which an input jumps or bends.
  double next_knot(double t) const { return std::min(motor_.next_knot(t), load_.next_knot(t)); }
  /// Highest angular frequency of the present inputs [rad/s].
  double fastest_input() const { return std::max(motor_piece().fastest(), load_.fastest()); }

  // ---- continuous motion --------------------------------------------------------------------------------------

  template <class S>
  Moment<S> moment(const S& t, const S& theta_g, const S& omega_g) const {
    return {t, theta_g, omega_g, mesh_.i * omega_g, mesh_.i * theta_g};
  }
  Moment<T> moment(const Instant& now) const { return moment(T(now.t), now.x[0], now.x[1]); }
  /// Torques on both sides of the mesh [N m]: tau_w on the worm, tau_g on the gear.
  template <class S>
  struct SideTorques {
    S worm, gear;
  };
  /// Those of motor and load alone.
  template <class S>
  SideTorques<S> inputs(const Moment<S>& at) const {
    return {effects_.motor_torque(motor_piece()(at.t), at), effects_.load_torque(load_, at)};
  }
  template <class S>
  SideTorques<S> side_torques(const Moment<S>& at, Motion motion) const {
    return side_torques(inputs(at), at, motion);
  }

  /// Coefficient of friction between the teeth while the drive moves, or starts to move, in a direction.
  template <class S>
  S friction(const Moment<S>& at, Motion motion) const {
    return effects_.friction(S(mesh_.mu), Contact<S>{at, motion, mesh_.sliding_speed(at.omega_w)});
  }

  /// Distance from the switching surface, tau_w - (Jw i/Jg) tau_g [N m]: the left flank carries while it is <= 0.
  template <class S>
  S beyond_surface(const Moment<S>& at, Motion motion) const {
    const SideTorques<S> tau = side_torques(at, motion);
    return tau.worm - surface() * tau.gear;
  }

  /// theta_g'' [rad/s^2] in a mode, 0 while stuck [YehWu2009, eq. 18-19].
  template <class S>
  S acceleration(const Moment<S>& at, Mode mode) const {
    return mode.motion == Motion::stuck ? S(T(0)) : acceleration(side_torques(at, mode.motion), at, mode);
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
      at.omega_w = mesh_.i * at.omega_g;
      at.theta_w = mesh_.i * at.theta_g;
      if (k == N) return at;
      const Flow a = acceleration(at, now.mode);
      at.theta_g[k + 1] = at.omega_g[k] / T(k + 1);
      at.omega_g[k + 1] = a[k] / T(k + 1);
    }
  }

  // ---- events -------------------------------------------------------------------------------------------------

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

  /// Values and rates of the guards along the motion.
  std::array<Series<T, 1>, guard_count> guards_ahead(const Instant& now) const {
    // what ahead<1> finds, without the rate of the acceleration, which would be thrown away
    Series<T, 1> theta_g(now.x[0]), omega_g(now.x[1]);
    theta_g[1] = now.x[1];
    omega_g[1] = acceleration(moment(now), now.mode);
    return guards(moment(Series<T, 1>::variable(T(now.t)), theta_g, omega_g), now.mode);
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
      const Motion reversed = now.mode.motion == Motion::forward ? Motion::backward : Motion::forward;
      now.mode = starts(now, reversed) ? moving(now, reversed) : Mode{};
    } else {
      now.mode.flank = flank_after_crossing(now);
    }
    return now;
  }

  /// The mode in which the drive goes on after inputs or state were set from outside; ties mean stick.
  Mode settle(const Instant& now) const {
    if (now.x[1] != T(0)) return moving(now, now.x[1] > T(0) ? Motion::forward : Motion::backward);
    for (const Motion motion : {Motion::forward, Motion::backward})
      if (starts(now, motion)) return moving(now, motion);
    return {};
  }

  /// The gear angle that the sensor sees [rad].
  T measured_angle(const Instant& now) const { return effects_.measured_angle(now.x[0]); }

  // ---- what is reported ---------------------------------------------------------------------------------------

  Observation observe(const Instant& now) const requires std::same_as<T, double> {
    const Moment<double> at = moment(now);
    const SideTorques<double> input = inputs(at), tau = side_torques(input, at, now.mode.motion);
    const double alpha = now.mode.motion == Motion::stuck ? 0.0 : acceleration(tau, at, now.mode);
    return {
        .theta_g = now.x[0],
        .omega_g = now.x[1],
        .alpha_g = alpha,
        .tau_m = input.worm,
        .tau_l = input.gear,
        .normal_force = mesh_.normal_force(tau.worm, tau.gear, Jg_ * alpha, now.mode, signed_friction(at, now.mode)),
        .mode = now.mode};
  }

 private:
  template <class S>
  SideTorques<S> side_torques(const SideTorques<S>& input, const Moment<S>& at, Motion motion) const {
    return {input.worm + effects_.worm_torque(at, motion), input.gear + effects_.gear_torque(at, motion)};
  }
  /// m = motion * flank * mu.
  template <class S>
  S signed_friction(const Moment<S>& at, Mode mode) const {
    if (!friction_changes_) return S(T(mode.product()) * mesh_.mu);
    return S(T(mode.product())) * friction(at, mode.motion);
  }
  template <class S>
  S acceleration(const SideTorques<S>& tau, const Moment<S>& at, Mode mode) const {
    const S C = mesh_.C(signed_friction(at, mode));
    return (tau.worm + C * tau.gear) / (Jw_i_ + C * Jg_);
  }
  /// Events closer than this are one event [s]. Where an input only touches a boundary, rounding places the event no
  /// better than the square root of epsilon in its period; still far below anything mechanical.
  double instant() const { return fastest_input() > 0.0 ? std::max(1e-11, 1e-7 / fastest_input()) : 1e-11; }
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
    if (!mesh_.has_teeth) return Flank::none;
    return beyond <= S(T(0)) ? Flank::left : Flank::right;
  }

  /// Whether the gear starts from rest in this direction: by its acceleration now or, where that is zero, just after.
  bool starts(const Instant& now, Motion motion) const {
    const Instant rest{now.t, {now.x[0], T(0)}, {}};
    const T a_now = release_acceleration(moment(rest), motion);
    if (lasts(a_now * Jw_i_, side_torques(moment(rest), motion))) return (a_now > T(0)) == (motion == Motion::forward);
    const auto a = release_acceleration(ahead<order>(rest), motion);
    return a[0] != T(0) && sign_just_after(a, instant()) == sign(motion);
  }

  /// The moving mode just after now: flank by the first derivative of the surface distance that does not vanish.
  Mode moving(const Instant& now, Motion motion) const {
    if (!mesh_.has_teeth) return {motion, Flank::none};
    const SideTorques<T> tau = side_torques(moment(now), motion);
    const T distance = tau.worm - surface() * tau.gear;
    const Flank now_on = flank_at(distance);
    if (lasts(distance, tau)) return {motion, now_on};
    const auto beyond = beyond_surface(ahead<order>({now.t, now.x, {motion, now_on}}), motion);
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
    if (side == 0) return now.mode.flank == Flank::left ? Flank::right : Flank::left;
    return side > 0 ? Flank::right : Flank::left;
  }

  GearMesh<T> mesh_;
  Load load_;
  Effects<T> effects_;
  MotorInput motor_;
  T Jw_i_{}, Jg_{};
  bool friction_changes_ = false;  ///< else C is that of the mesh alone
};

}  // namespace wormdrive
