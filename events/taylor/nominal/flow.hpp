#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "core/load.hpp"
#include "core/numbers/sine_cosine.hpp"
#include "core/worm_drive.hpp"
#include "events/taylor/accuracy.hpp"
#include "events/taylor/input.hpp"
#include "events/taylor/nominal/arm.hpp"
#include "events/taylor/nominal/driven.hpp"
#include "events/taylor/nominal/effects.hpp"
#include "events/taylor/nominal/equation.hpp"
#include "events/taylor/nominal/stribeck.hpp"
#include "events/taylor/series_step.hpp"

namespace wormdrive {

/// Drives whose motion has formulas of its own; here none.
template <class System>
class NominalFlow {
 public:
  static constexpr bool known = false;
  explicit NominalFlow(const System&) {}
};

template <class Load>
concept NominalLoad = std::is_same_v<Load, GravityLoad> || std::is_same_v<Load, TimedLoad>;

/// The motion of a drive by formulas of its own, where the motor's torque is affine in command and speed, at once or
/// with a lag, an arm under gravity or a torque over time loads it, its bearings are dry and viscous, and friction
/// between the teeth depends on the mode or falls with the speed: what SeriesFlow finds for any drive, many times
/// faster.
template <NominalLoad Load>
class NominalFlow<WormDrive<double, Load>> {
 public:
  static constexpr bool known = true;
  static constexpr bool swings = std::is_same_v<Load, GravityLoad>;
  using System = WormDrive<double, Load>;
  using Instant = typename System::Instant;
  using Motion = Expansion<System::guard_count>;

  /// The system must outlive the flow; its inputs may change between steps, its parameters must not.
  explicit NominalFlow(const System& system)
      : input_(system.motor_input()),
        motor_(system.motor_piece()),
        disturbance_(system.disturbance()),
        load_(system.load()),
        late_(system.effects().delay()),
        surface_(system.surface()) {
    if constexpr (swings) arm_angle_ = ArmAngle(load_.offset);
    const NominalEffects<swings> effects(system);
    covers_ = effects.are_covered;
    response_ = effects.response;
    curve_ = effects.curve;
    load_gain_ = effects.load_gain;
    for (int motion : {-1, 1})
      for (int flank : {-1, 0, 1})
        equations_[index(motion, flank)] = effects.equation(system, amplitude(), surface_, motion, flank);
  }

  /// False with an effect that this flow does not know.
  bool covers() const { return covers_; }

  /// Whether leaps are in closed form: torques are held, and one that lags decays to what is.
  bool inputs_are_constant() const {
    if constexpr (swings)
      return motor_.is_constant();
    else
      return motor_.is_constant() && load_.piece.is_constant();
  }

  /// Whether the motor's torque follows its command with a lag.
  bool lags() const { return input_.lags(); }

  /// Whether the load alone changes between samples: then a tape takes leaps that have no closed form here.
  bool load_alone_varies() const {
    if constexpr (swings)
      return false;
    else
      return motor_.is_constant() && !load_.piece.is_constant();
  }

  /// Whether a moving drive goes on in the latest mode after its inputs were set from outside: its torques are clear of
  /// the switching surface. Otherwise the equations of core/ have to decide.
  bool goes_on(const Instant& now) {
    if (!inputs_are_constant()) return false;
    HeldTorques held = held_torques(*mode_);
    if (input_.lags()) held = held + decaying_torques(now.t);
    return mode_->driven.held.goes_on(now.x[1], held, arm_at(now.x[0]));
  }
  /// A moving mode under held commands and the present load, where a leap is in closed form.
  std::optional<DrivenMotion> driven(Mode mode) const {
    if (!covers_ || !inputs_are_constant()) return std::nullopt;
    const NominalEquation& m = equation(mode);
    DrivenMotion driven = m.driven;
    driven.known = uncommanded_torques(m, 0.0);
    return driven;
  }
  /// Whether its bearings are viscous.
  bool rubs(Mode mode) const { return equation(mode).rubs; }
  /// How friction falls over the speed: the curve, and what that is in a moving mode.
  const StribeckCurve& curve() const { return curve_; }
  const FallOf<double>& fall(Mode mode) const { return equation(mode).fall; }
  /// What the motor makes of a command.
  const AffineMotor& response() const { return response_; }
  /// How the arm is turned against the gear.
  const SineAndCosine& arm_offset() const { return arm_angle_.offset(); }

  /// The latest mode.
  Mode mode() const { return mode_->mode; }

  /// Takes up the mode.
  void begin(const Instant& now) {
    // Modes outlast samples: a branch is foretold, an index would have to wait for the torque.
    if (now.mode != mode()) mode_ = &equation(now.mode);
  }

  /// One step to next while the inputs are constant, where HeldMotion can vouch for it; otherwise nothing changes.
  bool leap(Instant& now, double next, const TaylorAccuracy& accuracy) {
    if (!inputs_are_constant()) return false;
    const HeldTorques held = held_torques(*mode_);
    const SineAndCosine& arm = arm_at(now.x[0]);
    double h = next - now.t, &theta = now.x[0], &omega = now.x[1];
    if (input_.lags()) {
      const LaggingTorqueOf<double> lagging{decaying_torques(now.t), DecayOf<double>(h / input_.lag())};
      if (!mode_->driven.held.template leap<swings>(theta, omega, h, held, lagging, arm, accuracy)) return false;
    } else if (curve_.falls()) {
      if (!FallingLeap<double>::take<swings>(mode_->driven.held, mode_->fall, theta, omega, h, held, arm, accuracy))
        return false;
    } else if (mode_->rubs) {
      if (!mode_->driven.held.template leap<swings, true>(theta, omega, h, held, arm, accuracy)) return false;
    } else if (!mode_->driven.held.template leap<swings, false>(theta, omega, h, held, arm, accuracy)) {
      return false;
    }
    now.t = next;
    return true;
  }

  /// Those of coefficient k <= 2 of a guard where the latest step begins. Nothing where friction falls over the speed.
  std::optional<Terms> guard_terms(const Motion& e, double t, int guard, int k) const {
    if (!covers_ || curve_.falls()) return std::nullopt;
    const NominalEquation& m = *mode_;
    if (guard == System::flank_guard) return m.distance_terms(worm_terms(t, k), gear_terms(e, t, k), e.omega[k], k);
    if (k == 0) return Terms{std::abs(e.omega[0]), std::abs(e.omega[0])};
    const Terms rate = m.acceleration_terms(worm_terms(t, k - 1), gear_terms(e, t, k - 1), e.omega[k - 1], k - 1);
    return reciprocal[k] * rate;
  }

  /// The motion from now on, accurate over a step of at most h.
  void expand(const Instant& now, double h, const TaylorAccuracy& accuracy, Motion& e) {
    return curve_.falls() ? expand<true>(now, h, accuracy, e) : expand<false>(now, h, accuracy, e);
  }

 private:
  template <bool falls>
  void expand(const Instant& now, double h, const TaylorAccuracy& accuracy, Motion& e) {
    const NominalEquation& m = *mode_;
    if constexpr (falls) fall_.begin(m.fall, m.driven.held.motion, now.x[1]);
    const int last = accuracy.order();
    expand_motor(now.t, last);
    worm_torque_[0] += response_.offset + disturbance_;
    if constexpr (swings) {
      arm_.begin(arm_at(now.x[0]));
    } else {
      expand_input(load_.piece, now.t, last, load_gain_, gear_torque_);
    }

    e.theta[0] = now.x[0];
    e.omega[0] = now.x[1];
    double allowed = accuracy.allowed(e.omega[0], h);
    double power = 1.0 / h, alpha = m.friction.push;  // power: h^(k-1)
    bool suffices = false;
    int completed = 0;  // coefficients of angle and guards
    const auto next = [&]<int k>(std::integral_constant<int, k>) __attribute__((always_inline)) {
      if constexpr (swings && k > 0) arm_.turn(e.omega, k);
      if (k == last) return false;
      if constexpr (k >= TaylorAccuracy::least_order)
        if (std::abs(e.omega[k]) * power <= allowed) {
          complete(m, completed, k, e);
          completed = k + 1;
          suffices = accuracy.suffices(e, h) && (!falls || fall_.holds(k, h));
          if (suffices) return false;
          // a guard is near its root, and has to be exact to rounding; the speed has to be before it can be
          allowed = std::min(allowed, TaylorAccuracy::rounding_of(e.speed(), h) / h);
        }
      power *= h;
      // What is known first comes first: the series waits for the load.
      alpha += worm_torque_[k] * m.driven.per_worm_torque - m.driven.held.drag * e.omega[k];
      if constexpr (swings)
        alpha += m.driven.held.gravity * arm_.cosine(k);
      else
        alpha += gear_torque_[k] * m.per_gear_torque;
      if constexpr (falls) alpha += fall_.term(k, e.omega, beyond(m, k, e));
      e.omega[k + 1] = alpha * reciprocal[k + 1];
      alpha = 0.0;
      return true;
    };
    // One after the other without a loop: how many terms a sum has is known, and no branch is there to be mispredicted.
    [&]<int... k>(std::integer_sequence<int, k...>) { (next(std::integral_constant<int, k>()) && ...); }
    (std::make_integer_sequence<int, highest_order + 1>());
    e.step = h;
    if (suffices) return;
    complete(m, completed, last, e);
    e.step = accuracy.step(e, h);
    if constexpr (falls) e.step = longest(e.step, [&](double s) { return fall_.holds(last, s); });
  }

  /// Coefficients of the torque that the motor makes of its command, but for its offset.
  [[gnu::always_inline]] void expand_motor(double t, int last) {
    if (!input_.lags()) return expand_input(motor_, t - late_, last, response_.gain, worm_torque_);
    expand_torque(input_, t, last, worm_torque_.data());
    for (int k = 0; k <= last; ++k) worm_torque_[k] *= response_.gain;
  }

  static int index(int motion, int flank) { return (motion > 0 ? 3 : 0) + flank + 1; }
  const NominalEquation& equation(Mode mode) const { return equations_[index(sign(mode.motion), sign(mode.flank))]; }
  /// What is held beside the command.
  HeldTorques uncommanded_torques(const NominalEquation& m, double disturbance) const {
    HeldTorques rest = m.driven.known;
    if constexpr (!swings) {
      const double load = load_gain_ * load_.piece.constant;
      rest.push += load * m.per_gear_torque;
      rest.beyond -= load * surface_;
    }
    return {rest.push + disturbance * m.driven.per_worm_torque, rest.beyond + disturbance};
  }
  HeldTorques held_torques(const NominalEquation& m) const {
    const HeldTorques rest = uncommanded_torques(m, disturbance_);  // nothing but the command is left to wait for
    return {motor_.constant * m.driven.per_command + rest.push, motor_.constant * m.driven.gain + rest.beyond};
  }

  HeldTorques decaying_torques(double t) const { return mode_->driven.of_decaying(input_.decaying(t)); }

  /// Terms of coefficient k <= 2 of the torques on both sides where the latest step begins.
  Terms worm_terms(double t, int k) const {
    const double decaying = input_.lags() ? std::abs(input_.decaying(t)) * std::pow(1.0 / input_.lag(), k) : 0.0;
    return {std::abs(worm_torque_[k]), std::abs(response_.gain) * (most_of_input(motor_, t - late_, k) + decaying) +
                                           (k == 0 ? std::abs(response_.offset) + std::abs(disturbance_) : 0.0)};
  }
  Terms gear_terms(const Motion& e, double t, int k) const {
    if constexpr (swings) {
      const double v = std::abs(e.omega[0]), turned = k == 0 ? 1.0 : k == 1 ? v : 0.5 * (v * v + std::abs(e.omega[1]));
      return std::abs(load_.amplitude) * Terms{std::abs(arm_.cosine(k)), turned};
    } else {
      return {std::abs(gear_torque_[k]), std::abs(load_gain_) * most_of_input(load_.piece, t, k)};
    }
  }
  double amplitude() const {
    if constexpr (swings)
      return load_.amplitude;
    else
      return 0.0;
  }
  const SineAndCosine& arm_at(double theta_g) {
    if constexpr (!swings) return arm_angle_.latest();
    return arm_angle_.at(theta_g);
  }

  /// Angle and guards to the order to which the speed is known, from coefficient first on.
  void complete(const NominalEquation& m, int first, int order, Motion& e) const {
    e.order = order;
    Coefficients &speed = e.guards[System::speed_guard], &flank = e.guards[System::flank_guard];
    const double side = -m.driven.held.flank, motion = m.driven.held.motion;
    for (int k = first; k <= order; ++k) e.theta[k + 1] = e.omega[k] * reciprocal[k + 1];
    for (int k = first; k <= order; ++k) speed[k] = motion * e.omega[k];
    for (int k = first; k <= order; ++k) flank[k] = side * beyond(m, k, e);
    if (side == 0.0) flank[0] = 1.0;
  }
  /// Coefficient k of the distance from the switching surface.
  double beyond(const NominalEquation& m, int k, const Motion& e) const {
    const double load = swings ? m.driven.held.lift * arm_.cosine(k) : surface_ * gear_torque_[k];
    const double distance = worm_torque_[k] - load - m.driven.held.skew * e.omega[k];
    return k == 0 ? distance + m.friction.beyond : distance;
  }

  const MotorInput<double>& input_;
  const Piece& motor_;
  const double& disturbance_;  ///< of the worm's shaft, beside the motor [N m]
  const Load& load_;
  double late_;  ///< how old a command is that the motor has [s]
  double surface_;
  AffineMotor response_;    ///< of the motor to its command
  double load_gain_ = 1.0;  ///< of a load over time
  bool covers_ = true;
  std::array<NominalEquation, 6> equations_{};
  const NominalEquation* mode_ = &equations_[0];  ///< that of the latest mode
  StribeckCurve curve_;
  FallSeriesOf<double, highest_order + 2> fall_;  ///< of friction in the latest step
  Coefficients worm_torque_{}, gear_torque_{};    ///< of the inputs in the latest step
  ArmSeries arm_;                                 ///< the arm's angle in the latest step
  ArmAngle arm_angle_;
};

}  // namespace wormdrive
