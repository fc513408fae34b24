#pragma once
#include <array>
#include <string_view>
#include <utility>

#include <Eigen/Core>
#include <ceres/jet.h>

#include "core/elastic/compliant_mode.hpp"
#include "core/elastic/contact_law.hpp"
#include "core/elastic/dry_shafts.hpp"
#include "core/numbers/portable.hpp"
#include "core/worm_drive.hpp"

namespace wormdrive {

/// Worm and gear as two inertias with elastic teeth and backlash, a hybrid system like the rigid drive, whose inputs,
/// load and effects it takes over. The flanks approach each other as the ratio i says, whatever the radii give.
template <class T, class Load>
class CompliantDrive {
 public:
  static constexpr int state_size = 4;
  using State = Eigen::Matrix<T, 4, 1>;     ///< theta_w, theta_w', theta_g, theta_g' [rad, rad/s]
  using Jacobian = Eigen::Matrix<T, 4, 4>;  ///< of the derivative to the state
  using Mode = CompliantMode;
  static constexpr int guard_count = 6;

  /// Time [s], state and mode: all that changes while a drive runs.
  struct Instant {
    double t{};
    State x = State::Zero();
    Mode mode{};
  };

  CompliantDrive(WormDrive<T, Load> rigid, ToothContact<T> contact)
      : rigid_(std::move(rigid)), contact_(std::move(contact)) {
    using portable::cos, portable::sin;
    const GearMesh<T>& teeth = mesh();
    worm_normal_ = teeth.worm_arm(T(0));
    gear_normal_ = teeth.gear_arm(T(0));
    worm_lateral_ = cos(teeth.lambda) * teeth.lw;
    gear_lateral_ = sin(teeth.lambda) * teeth.lg;
    worm_is_dry_ = teeth.mu > T(0) || effects().change_friction() || wormdrive::worm_is_dry(rigid_);
    gear_is_dry_ = wormdrive::gear_is_dry(rigid_);
  }

  const GearMesh<T>& mesh() const { return rigid_.mesh(); }
  const WormDrive<T, Load>& rigid() const { return rigid_; }
  const Effects<T>& effects() const { return rigid_.effects(); }
  double torque_limit() const { return rigid_.torque_limit(); }
  const ToothContact<T>& contact() const { return contact_; }
  void enter(double t) { rigid_.enter(t); }  // inputs are those of the rigid drive
  void rewind() { rigid_.rewind(); }
  bool command(double t, double tau_m) { return rigid_.command(t, tau_m); }
  void disturb(double torque) { rigid_.disturb(torque); }
  const double& disturbance() const { return rigid_.disturbance(); }
  double next_knot(double t) const { return rigid_.next_knot(t); }
  double fastest_input(double t) const { return rigid_.fastest_input(t); }
  template <class S>
  Moment<S> moment(const S& t, const S& theta_w, const S& omega_w, const S& theta_g, const S& omega_g) const {
    return {t, theta_g, omega_g, omega_w, theta_w};
  }
  Moment<T> moment(const Instant& now) const { return moment(T(now.t), now.x[0], now.x[1], now.x[2], now.x[3]); }

  /// Normal penetration d of the teeth on a flank [m] and its rate [m/s]; negative while they are apart.
  template <class S>
  std::pair<S, S> penetration(const Moment<S>& at, Flank flank) const {
    const T side = T(sign(flank)) * gear_normal_;
    return {side * (at.theta_g - at.theta_w / mesh().i) - gear_normal_ * contact_.backlash / T(2),
            side * (at.omega_g - at.omega_w / mesh().i)};
  }
  /// Wn [N], 0 in the gap.
  template <class S>
  S normal_force(const Moment<S>& at, Mode mode) const {
    if (mode.contact == Flank::none) return S(T(0));
    const auto [d, v] = penetration(at, mode.contact);
    return contact_.force(d, v);
  }
  /// Wf [N], positive against forward motion. At rest it holds the worm as far as it can; bearings hold the rest.
  template <class S, template <class> class M>
  S friction(const M<S>& at, Mode mode, const S& Wn) const {
    const auto sliding = [&](Motion motion) { return S(T(sign(motion)) * rigid_.friction(at, motion) * Wn); };
    if (mode.contact == Flank::none) return S(T(0));
    if (mode.worm != Motion::stuck) return sliding(mode.worm);
    const S holding =
        (rigid_.side_torques(at, Motion::stuck).worm + T(sign(mode.contact)) * worm_normal_ * Wn) / worm_lateral_;
    const S most = sliding(Motion::forward), least = sliding(Motion::backward);
    return holding > most ? most : holding < least ? least : holding;
  }
  /// theta_w'' and theta_g'' [rad/s^2], 0 for a shaft that is stuck.
  template <class S>
  struct Accelerations {
    S worm, gear;
  };
  template <class S, template <class> class M>
  Accelerations<S> accelerations(const M<S>& at, Mode mode) const {
    const S Wn = normal_force(at, mode), Wf = friction(at, mode, Wn), push = T(sign(mode.contact)) * Wn;
    Accelerations<S> a{S(T(0)), S(T(0))};
    if (mode.worm != Motion::stuck)
      a.worm = (rigid_.side_torques(at, mode.worm).worm + push * worm_normal_ - Wf * worm_lateral_) / mesh().Jw;
    if (mode.gear != Motion::stuck)
      a.gear = (rigid_.side_torques(at, mode.gear).gear - push * gear_normal_ - Wf * gear_lateral_) / rigid_.Jg(at);
    return a;
  }

  State derivative(double t, const State& x, Mode mode) const {
    const Accelerations<T> a = accelerations(moment(T(t), x[0], x[1], x[2], x[3]), mode);
    return {mode.worm == Motion::stuck ? T(0) : x[1], a.worm, mode.gear == Motion::stuck ? T(0) : x[3], a.gear};
  }
  /// Exact Jacobian of the derivative, by automatic differentiation.
  Jacobian jacobian(double t, const State& x, Mode mode) const requires std::same_as<T, double> {
    using Jet = ceres::Jet<double, 4>;
    const auto a = accelerations(moment(Jet(t), Jet(x[0], 0), Jet(x[1], 1), Jet(x[2], 2), Jet(x[3], 3)), mode);
    Jacobian J = Jacobian::Zero();
    J(0, 1) = mode.worm == Motion::stuck ? 0.0 : 1.0;
    J(2, 3) = mode.gear == Motion::stuck ? 0.0 : 1.0;
    J.row(1) = a.worm.v.transpose();
    J.row(3) = a.gear.v.transpose();
    return J;
  }

  /// Time, angles and speeds along the motion in the present mode, as power series to order N; with Rounded for a
  /// scalar every coefficient knows its rounding.
  template <int N, class C = T>
  Moment<Series<C, N>> ahead(const Instant& now) const {
    return along<Series<C, N>>(now, N);
  }
  /// The same to any order up to highest_series.
  Moment<OpenSeries<T>> ahead(const Instant& now, int order) const { return along<OpenSeries<T>>(now, order); }

  /// The state at a moment, in the order of State.
  template <class S>
  static std::array<S, state_size> state_at(const Moment<S>& at) {
    return {at.theta_w, at.omega_w, at.theta_g, at.omega_g};
  }

  // ---- events -------------------------------------------------------------------------------------------------

  /// At rest nothing moves; a worm that sticks under a gear that swings is not at rest.
  static bool at_rest(Mode mode) { return mode.worm == Motion::stuck && mode.gear == Motion::stuck; }

  /// Whether a shaft moves and has no speed yet.
  static bool leaves_rest(const Instant& now) {
    return (now.mode.worm != Motion::stuck && now.x[1] == T(0)) || (now.mode.gear != Motion::stuck && now.x[3] == T(0));
  }

  /// Lets the speeds be as the mode has them: rounding leaves them on either side of zero.
  void keep_within_mode(Instant& now) const {
    for (const Shaft shaft : {Shaft::worm, Shaft::gear})
      if (T& speed = now.x[speed_of(shaft)]; is_dry(shaft) && T(sign(now.mode[shaft])) * speed < T(0)) speed = T(0);
  }

  /// Functions that are positive while the mode holds and fall through zero when it ends: in contact the normal force,
  /// in the gap the distance to each flank; for a moving shaft its speed, for a stuck one its two margins to break-in.
  template <class S, template <class> class M>
  std::array<S, guard_count> guards(const M<S>& at, Mode mode) const {
    std::array<S, guard_count> g;
    g.fill(S(T(1)));
    if (mode.contact == Flank::none) {
      g[contact_guards] = apart(at, Flank::left);
      g[contact_guards + 1] = apart(at, Flank::right);
    } else {
      g[contact_guards] = normal_force(at, mode);
    }
    for (const Shaft shaft : {Shaft::worm, Shaft::gear}) {
      if (!is_dry(shaft)) continue;
      S* const own = &g[first_guard(shaft)];
      if (mode[shaft] == Motion::stuck) {
        own[0] = -release_acceleration(at, mode, shaft, Motion::forward);
        own[1] = release_acceleration(at, mode, shaft, Motion::backward);
      } else {
        own[0] = T(sign(mode[shaft])) * (shaft == Shaft::worm ? at.omega_w : at.omega_g);
      }
    }
    return g;
  }
  /// Values and rates of the guards along the motion.
  std::array<Series<T, 1>, guard_count> guards_ahead(const Instant& now) const {
    return guards(ahead<1>(now), now.mode);
  }

  static std::string_view guard_name(Mode mode, int guard) { return name_of_guard(mode, guard); }

  /// The state after a guard has fired. The crossing itself is trusted: its condition is not tested again.
  Instant jump(Instant now, int guard) const {
    if (guard < worm_guards) {
      const Flank opened = now.mode.contact;
      now.mode.contact = Flank::none;
      const Flank other = opened == Flank::left || guard != contact_guards ? Flank::right : Flank::left;
      if (opened == Flank::none || touches(now, other)) now.mode.contact = other;  // at once without backlash
    } else {
      const Shaft shaft = guard < gear_guards ? Shaft::worm : Shaft::gear;
      if (now.mode[shaft] == Motion::stuck) {
        now.mode = now.mode.with(shaft, guard % 2 == 0 ? Motion::forward : Motion::backward);
      } else {
        now.x[speed_of(shaft)] = T(0);
        now.mode = now.mode.with(shaft, Motion::stuck);
      }
    }
    now.mode = released(now);
    return now;
  }

  /// The mode in which the drive goes on after inputs or state were set from outside; ties mean stick.
  Mode settle(Instant now) const {
    for (const Shaft shaft : {Shaft::worm, Shaft::gear}) {
      const T& speed = now.x[speed_of(shaft)];
      const bool forward = !is_dry(shaft) || speed > T(0);
      now.mode = now.mode.with(shaft, forward ? Motion::forward : speed < T(0) ? Motion::backward : Motion::stuck);
    }
    now.mode.contact = Flank::none;
    const Instant free{now.t, now.x, released(now)};
    for (const Flank flank : {Flank::left, Flank::right})
      if (touches(free, flank)) now.mode.contact = flank;
    return released(now);
  }

  /// The gear angle that the sensor sees [rad].
  T measured_angle(const Instant& now) const { return effects().measured_angle(now.x[2]); }

  Observation observe(const Instant& now) const requires std::same_as<T, double> {
    const Moment<double> at = moment(now);
    const Accelerations<double> a = accelerations(at, now.mode);
    const auto input = rigid_.inputs(at, now.mode.gear);
    const double Wn = normal_force(at, now.mode);
    return {.theta_g = at.theta_g,
            .omega_g = at.omega_g,
            .alpha_g = a.gear,
            .tau_m = input.worm,
            .tau_l = input.gear,
            .normal_force = Wn,
            .mode = now.mode,
            .teeth = ElasticTeeth{at.theta_w, at.omega_w, a.worm, at.theta_g - at.theta_w / mesh().i,
                                  friction(at, now.mode, Wn), now.mode.gear},
            .winding = winding(effects(), rigid_.motor_command(at.t), at)};
  }

 private:
  template <class Flow>
  Moment<Flow> along(const Instant& now, int order) const {
    using C = ConstantOf<Flow>;
    Moment<Flow> at =
        moment(Flow::variable(C(now.t), 1), Flow(now.x[0]), Flow(now.x[1]), Flow(now.x[2]), Flow(now.x[3]));
    Accelerations<C> a = accelerations(moment(C(now.t), C(now.x[0]), C(now.x[1]), C(now.x[2]), C(now.x[3])), now.mode);
    for (int k = 0, last = at.t.within(order); k < last; ++k) {
      if (k > 0) {
        const auto known = accelerations(at, now.mode);
        a = {known.worm[k], known.gear[k]};
      }
      at.t.know(k + 1);
      at.theta_w.append(k + 1, at.omega_w[k] / C(k + 1));
      at.omega_w.append(k + 1, a.worm / C(k + 1));
      at.theta_g.append(k + 1, at.omega_g[k] / C(k + 1));
      at.omega_g.append(k + 1, a.gear / C(k + 1));
    }
    return at;
  }
  static constexpr int deciding = 3;  ///< order of the series that decide what happens just after an event

  static int speed_of(Shaft shaft) { return shaft == Shaft::worm ? 1 : 3; }
  static int first_guard(Shaft shaft) { return shaft == Shaft::worm ? worm_guards : gear_guards; }
  bool is_dry(Shaft shaft) const { return shaft == Shaft::worm ? worm_is_dry_ : gear_is_dry_; }

  template <class S>
  S apart(const Moment<S>& at, Flank flank) const {
    const auto [d, v] = penetration(at, flank);
    return contact_.apart(d, v);
  }
  /// Whether the teeth push on a flank just after now.
  bool touches(const Instant& now, Flank flank) const {
    return sign_just_after(apart(ahead<deciding, Rounded>(now), flank), time_resolution(now.t)) < 0;
  }

  /// The acceleration that a shaft at rest would have, moving in this direction.
  template <class S, template <class> class M>
  S release_acceleration(const M<S>& at, Mode mode, Shaft shaft, Motion motion) const {
    const Accelerations<S> a = accelerations(at, mode.with(shaft, motion));
    return shaft == Shaft::worm ? a.worm : a.gear;
  }
  /// The mode in which each shaft that rests goes on, by the first derivative of its acceleration that matters.
  Mode released(const Instant& now) const {
    Mode mode = now.mode;
    for (const Shaft shaft : {Shaft::worm, Shaft::gear}) {
      if (mode[shaft] != Motion::stuck) continue;
      const auto at = ahead<deciding, Rounded>({now.t, now.x, mode});
      for (const Motion motion : {Motion::forward, Motion::backward})
        if (sign_just_after(release_acceleration(at, mode, shaft, motion), time_resolution(now.t)) == sign(motion))
          mode = mode.with(shaft, motion);
    }
    return mode;
  }

  WormDrive<T, Load> rigid_;
  ToothContact<T> contact_;
  T worm_normal_{}, gear_normal_{};    ///< lever arms of the normal force on worm and gear [m]
  T worm_lateral_{}, gear_lateral_{};  ///< lever arms of the friction force on worm and gear [m]
  bool worm_is_dry_ = false, gear_is_dry_ = false;
};

}  // namespace wormdrive
