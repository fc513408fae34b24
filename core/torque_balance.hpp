#pragma once
#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

#include "core/effects.hpp"
#include "core/loads/given_load.hpp"
#include "core/mesh.hpp"
#include "core/moment.hpp"
#include "core/motor_input.hpp"

namespace wormdrive {

/// The torques on both shafts of a rigid worm drive and what they come to in a mode: one linear equation [YehWu2009,
/// eq. 18-19]. Inputs (motor torque and a load over time) are frozen to the smooth piece that holds now.
///
/// T is the scalar of the parameters, the scalar S of a moment may differ (derivatives along the motion).
template <class T, class Load>
class TorqueBalance {
 public:
  TorqueBalance(GearMesh<T> mesh, Load load, Effects<T> effects, Signal motor)
      : mesh_(std::move(mesh)),
        load_(std::move(load)),
        effects_(std::move(effects)),
        motor_(std::move(motor), effects_.torque_limit(), effects_.delay(), effects_.lag()) {
    mesh_.Jw = mesh_.Jw + effects_.worm_inertia();
    mesh_.Jg = mesh_.Jg + effects_.gear_inertia();
    Jw_i_ = mesh_.Jw * mesh_.i;
    Jg_ = mesh_.Jg + (effects_.twisting_coupling() ? 0.0 : load_.inertia());
    friction_changes_ = effects_.change_friction();
    pitch_varies_ = effects_.pitch_varies();
    load_inertia_varies_ = effects_.inertia_varies();
    inertia_varies_ = load_inertia_varies_ && !effects_.twisting_coupling();
    ripple_ = std::max(effects_.ripple(value_of(mesh_.i)), load_.ripple());
    bends_with_load_ = effects_.bend_with_load();
    bend_count_ = counted_bends<Moment>();
    bend_count_with_states_ = counted_bends<MomentOfEffects>();
  }

  /// The mesh with the inertias that effects add; its friction is that without effects.
  const GearMesh<T>& mesh() const { return mesh_; }
  const Load& load() const { return load_; }
  const Effects<T>& effects() const { return effects_; }
  /// Largest magnitude of the motor's command [N m], infinity without a limit.
  double torque_limit() const { return motor_.limit(); }
  /// Inertia of the gear side with the load's own [kg m^2], unless that turns behind a coupling.
  T Jg() const { return Jg_; }
  /// The same with what depends on the angle.
  template <class S>
  S Jg(const Moment<S>& at) const {
    return inertia_varies_ ? S(Jg_ + effects_.inertia_at(at.theta_g).inertia) : S(Jg_);
  }
  /// Slope of the switching surface, Jw i / Jg [YehWu2009, eq. 17].
  T surface() const { return Jw_i_ / Jg_; }

  // ---- inputs -------------------------------------------------------------------------------------------------

  /// Freezes the inputs to the pieces that hold from t on.
  void enter(double t) {
    enter_load(t);
    enter_motor(t);
  }
  void enter_load(double t) {
    load_.enter(t);
    effects_.enter(t);
  }
  void enter_motor(double t) { motor_.enter(t); }
  /// When the motor's present piece has arrived [s], with derivatives.
  const T& motor_arrival() const { return motor_.arrival(); }
  /// Forgets the inputs of the past, for a new run from its start.
  void rewind() {
    motor_.rewind();
    disturbance_ = 0.0;
  }
  /// Holds a motor torque [N m] from t on, in addition to the motor's signal; whether the next knot may be another one
  /// now. The caller settles the mode.
  bool command(double t, double tau_m) { return motor_.command(t, tau_m); }
  void resume_motor(double t, double torque) { motor_.resume(t, torque); }
  /// Disturbs the worm's shaft with a torque [N m] from now on, whatever the motor does. The caller settles the mode.
  void disturb(double torque) { disturbance_ = torque; }
  /// What disturbs the worm's shaft now [N m].
  const double& disturbance() const { return disturbance_; }
  /// What the motor is commanded at a time of the present pieces [N m].
  template <class S>
  S motor_command(const S& t) const {
    return motor_(t);
  }
  /// What the motor is told at a moment [N m].
  template <class S, template <class> class M>
  S command_at(const M<S>& at) const {
    if constexpr (requires { at.command; })
      return at.command;
    else
      return motor_(at.t);
  }
  /// The load at a moment, which may say itself what its functions of time come to.
  template <class S, template <class> class M>
  decltype(auto) load_at(const M<S>& at) const {
    if constexpr (requires { at.load_over_time; })
      return GivenLoad<Load, S>{load_, at.load_over_time};
    else
      return (load_);
  }
  /// The smooth piece of the motor's command that holds now [N m].
  const Piece& motor_piece() const { return motor_.piece(); }
  const MotorInput<T>& motor_input() const { return motor_; }
  /// First time after t at which an input jumps or bends.
  double next_knot(double t) const {
    return std::min({motor_.next_knot(t), load_.next_knot(t), effects_.next_knot(t)});
  }
  /// Highest angular frequency of the present inputs from t on [rad/s].
  double fastest_input(double t = -std::numeric_limits<double>::infinity()) const {
    return std::max(motor_.fastest(t), load_.fastest());
  }

  /// Highest number of periods per radian of the gear in what depends on its angle.
  double ripple() const { return ripple_; }

  /// How many quantities there are at whose zeros the equations bend, as where a stop is met. M: a moment, with the
  /// states of effects or without.
  template <template <class> class M>
  int bend_count() const {
    return std::is_same_v<M<T>, MomentOfEffects<T>> ? bend_count_with_states_ : bend_count_;
  }
  /// Calls visit with each of them, always in the same order.
  template <class S, template <class> class M, class Visit>
  void for_each_bend(const M<S>& at, Motion motion, Visit&& visit) const {
    const Moment<S> at_load = effects_.at_load(at);
    if constexpr (requires { load_.for_each_bend(at_load, visit); }) load_.for_each_bend(at_load, visit);
    if (bends_with_load_) visit(effects_.load_torque(load_at(at), at, motion));
    if constexpr (requires { at.states; }) {
      // the direction of a load behind a coupling is no mode of the drive
      if constexpr (requires { load_.depends_on_direction(); })
        if (effects_.twisting_coupling() && load_.depends_on_direction()) visit(at_load.omega_g);
      effects_.for_each_bend(command_at(at), at, visit);
      // With states rest is integrated. Its margins bend where another flank would carry what starts.
      if (mesh_.has_teeth)
        for (const Motion way : {Motion::forward, Motion::backward})
          visit(motion == Motion::stuck ? beyond_surface(at, way) : S(T(1)));
    }
  }

  // ---- torques ------------------------------------------------------------------------------------------------

  template <class S>
  Moment<S> moment(const S& t, const S& theta_g, const S& omega_g) const {
    Moment<S> at{t, theta_g, omega_g, {}};
    turn_worm(at);
    return at;
  }
  /// Lets the worm follow the gear.
  template <class S>
  void turn_worm(Moment<S>& at) const {
    at.omega_w = mesh_.i * at.omega_g;
    at.theta_w = mesh_.i * at.theta_g;
    if (!pitch_varies_) return;
    const Transmission<S> worm = effects_.transmission(at.theta_g);
    at.omega_w = worm.slope * at.omega_w;
    at.theta_w = mesh_.i * worm.angle;
  }

  /// Torques on both sides of the mesh [N m]: tau_w on the worm, tau_g on the gear.
  template <class S>
  struct SideTorques {
    S worm, gear;
  };
  /// Those of motor and load alone, while the gear moves, or starts to move, in a direction. M is a moment, with the
  /// states of effects or without.
  template <class S, template <class> class M>
  SideTorques<S> inputs(const M<S>& at, Motion motion) const {
    return {effects_.motor_torque(command_at(at), at), effects_.load_torque(load_at(at), at, motion)};
  }
  template <class S, template <class> class M>
  SideTorques<S> side_torques(const M<S>& at, Motion motion) const {
    return side_torques(inputs(at, motion), at, motion);
  }

  /// Coefficient of friction between the teeth while the drive moves, or starts to move, in a direction.
  template <class S, template <class> class M>
  S friction(const M<S>& at, Motion motion) const {
    return effects_.friction(S(mesh_.mu), SlidingContact<S>{at, motion, mesh_.sliding_speed(at.omega_w)}, at);
  }

  /// Distance from the switching surface, tau_w - (Jw i/Jg) tau_g [N m]: the left flank carries while it is <= 0.
  template <class S, template <class> class M>
  S beyond_surface(const M<S>& at, Motion motion) const {
    return beyond_surface(side_torques(at, motion), at);
  }

  /// theta_g'' [rad/s^2] in a mode, 0 while stuck [YehWu2009, eq. 18-19].
  template <class S, template <class> class M>
  S acceleration(const M<S>& at, Mode mode) const {
    return mode.motion == Motion::stuck ? S(T(0)) : acceleration(side_torques(at, mode.motion), at, mode);
  }

  // ---- the same from torques that are known already -----------------------------------------------------------

  template <class S, template <class> class M>
  SideTorques<S> side_torques(const SideTorques<S>& input, const M<S>& at, Motion motion) const {
    if constexpr (requires { at.disturbance; })
      return with_bearings<S>({input.worm + at.disturbance, input.gear}, at, motion);
    else
      return with_bearings<S>({input.worm + disturbance_, input.gear}, at, motion);
  }
  template <class S, template <class> class M>
  SideTorques<S> with_bearings(const SideTorques<S>& input, const M<S>& at, Motion motion) const {
    const S worm = motion == Motion::stuck ? worm_torque_at_rest(at) : effects_.worm_torque(at, motion);
    SideTorques<S> tau{input.worm + worm, input.gear + effects_.gear_torque(input.gear, at, motion)};
    // Jg theta_g'' + Jg' theta_g'^2/2 is what balances them; the second term counts as a torque. Without states the
    // load turns with the gear, whatever the coupling.
    if (requires { at.states; } ? inertia_varies_ : load_inertia_varies_)
      tau.gear = tau.gear - T(0.5) * effects_.inertia_at(at.theta_g).slope * (at.omega_g * at.omega_g);
    return tau;
  }
  /// What the worm's bearings do at rest: nothing, unless one that pushes cannot do as little.
  template <class S, template <class> class M>
  S worm_torque_at_rest(const M<S>& at) const {
    const S idle = effects_.worm_torque(at, Motion::stuck);
    const S least = effects_.worm_torque(at, Motion::forward), most = effects_.worm_torque(at, Motion::backward);
    return idle < least ? least : idle > most ? most : idle;
  }
  /// m = motion * flank * mu.
  template <class S, template <class> class M>
  S signed_friction(const M<S>& at, Mode mode) const {
    if (!friction_changes_) return S(T(mode.product()) * mesh_.mu);
    return S(T(mode.product())) * friction(at, mode.motion);
  }
  template <class S, template <class> class M>
  S acceleration(const SideTorques<S>& tau, const M<S>& at, Mode mode) const {
    if (!friction_changes_ && !pitch_varies_ && !inertia_varies_) {
      using Scalar = ConstantOf<S>;
      const Scalar C = mesh_.C(Scalar(T(mode.product()) * mesh_.mu));
      return (tau.worm + C * tau.gear) / (Jw_i_ + C * Jg_);
    }
    const S C = mesh_.C(signed_friction(at, mode));
    if (!pitch_varies_) return (tau.worm + C * tau.gear) / (Jw_i_ + C * Jg(at));
    // the worm's balance, as work at the gear: its lever arms are 1/k of those of an even pitch
    const Transmission<S> worm = effects_.transmission(at.theta_g);
    const S inertial = Jw_i_ * worm.curvature * (at.omega_g * at.omega_g);
    return (worm.slope * (tau.worm - inertial) + C * tau.gear) / (Jw_i_ * worm.slope * worm.slope + C * Jg(at));
  }
  /// tau_w - Jw theta_w'' where the flanks do not push: theta_g'' = tau_g/Jg.
  template <class S>
  S beyond_surface(const SideTorques<S>& tau, const Moment<S>& at) const {
    if (!pitch_varies_ && !inertia_varies_) return tau.worm - surface() * tau.gear;
    const S surface = Jw_i_ / Jg(at);
    if (!pitch_varies_) return tau.worm - surface * tau.gear;
    const Transmission<S> worm = effects_.transmission(at.theta_g);
    return tau.worm - surface * (worm.slope * tau.gear) - Jw_i_ * worm.curvature * (at.omega_g * at.omega_g);
  }
  /// Wn [N] where the gear accelerates so [rad/s^2], 0 at rest.
  template <class S, template <class> class M>
  S normal_force(const SideTorques<S>& tau, const M<S>& at, const S& alpha, Mode mode) const {
    const S worm =
        pitch_varies_ ? effects_.transmission(at.theta_g).slope * tau.worm : tau.worm;  // on one of even pitch
    return mesh_.normal_force(worm, tau.gear, S(Jg(at) * alpha), mode, signed_friction(at, mode));
  }
  /// Power that friction takes [W]: mu Wn |sliding speed| in the mesh, and that of the bearings.
  template <class S, template <class> class M>
  S friction_loss(const M<S>& at, Mode mode) const {
    if (mode.motion == Motion::stuck) return S(T(0));
    const SideTorques<S> input = inputs(at, mode.motion), tau = side_torques(input, at, mode.motion);
    const S bearings = -effects_.worm_torque(at, mode.motion) * at.omega_w -
                       effects_.gear_torque(input.gear, at, mode.motion) * at.omega_g;
    if (!mesh_.has_teeth) return bearings;
    // where the pitch is uneven, the worm's lever arms are shorter as its speed is greater: that of an even one counts
    const S inertial = Jg(at) * acceleration(tau, at, mode), m = signed_friction(at, mode);
    const S Wn = mesh_.normal_force(tau.gear, inertial, mode.flank, m);
    const S sliding = T(sign(mode.motion)) * mesh_.sliding_speed(S(mesh_.i * at.omega_g));
    return bearings + friction(at, mode.motion) * Wn * sliding;
  }

 private:
  template <template <class> class M>
  int counted_bends() const {
    int count = 0;
    for_each_bend(M<T>{turning<T>()}, Motion::stuck, [&](const auto&) { ++count; });
    return count;
  }

  GearMesh<T> mesh_;
  Load load_;
  Effects<T> effects_;
  MotorInput<T> motor_;
  double disturbance_ = 0.0;
  T Jw_i_{}, Jg_{};
  bool friction_changes_ = false;  ///< else C is that of the mesh alone
  bool pitch_varies_ = false;      ///< else theta_w = i theta_g
  bool inertia_varies_ = false;    ///< else Jg is that of every angle
  bool load_inertia_varies_ = false;
  double ripple_ = 0.0;
  bool bends_with_load_ = false;
  int bend_count_ = 0, bend_count_with_states_ = 0;
};

}  // namespace wormdrive
