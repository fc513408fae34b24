#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "core/load.hpp"
#include "core/sine_cosine.hpp"
#include "core/worm_drive.hpp"
#include "events/taylor_accuracy.hpp"
#include "events/taylor_leap.hpp"

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

/// The motion of a drive with nothing but an arm under gravity, or a load over time, and dry and viscous bearings, by
/// formulas of its own: what SeriesFlow finds for any drive, many times faster.
template <NominalLoad Load>
class NominalFlow<WormDrive<double, Load>> {
 public:
  static constexpr bool known = true;
  using System = WormDrive<double, Load>;
  using Instant = typename System::Instant;
  using Motion = Expansion<System::guard_count>;

  /// The system must outlive the flow; its inputs may change between calls of begin, its parameters must not.
  explicit NominalFlow(const System& system)
      : motor_(system.motor_piece()),
        load_(system.load()),
        surface_(system.surface()),
        has_teeth_(system.mesh().has_teeth) {
    double worm_coulomb = 0.0, gear_coulomb = 0.0, worm_viscous = 0.0, gear_viscous = 0.0;
    system.effects().for_each([&]<class E>(const std::optional<E>& effect) {
      if (!effect) return;
      if constexpr (std::is_same_v<E, WormCoulomb<double>>)
        worm_coulomb = effect->torque;
      else if constexpr (std::is_same_v<E, GearCoulomb<double>>)
        gear_coulomb = effect->torque;
      else if constexpr (std::is_same_v<E, WormViscous<double>>)
        worm_viscous = effect->coefficient * system.mesh().i;
      else if constexpr (std::is_same_v<E, GearViscous<double>>)
        gear_viscous = effect->coefficient;
      else if constexpr (!contained<E>)
        covers_ = false;
    });
    const GearMesh<double>& mesh = system.mesh();
    for (int motion : {-1, 1})
      for (int flank : {-1, 0, 1}) {
        const double C = mesh.C(motion * flank * mesh.mu), inverse = 1.0 / (mesh.Jw * mesh.i + C * system.Jg());
        equations_[index(motion, flank)] = {.held = {.motion = static_cast<double>(motion),
                                                     .flank = static_cast<double>(flank),
                                                     .gravity = amplitude() * C * inverse,
                                                     .drag = (worm_viscous + C * gear_viscous) * inverse,
                                                     .lift = amplitude() * surface_,
                                                     .skew = worm_viscous - surface_ * gear_viscous},
                                            .per_worm_torque = inverse,
                                            .per_gear_torque = C * inverse,
                                            .worm_friction = -motion * worm_coulomb,
                                            .gear_friction = -motion * gear_coulomb};
      }
  }

  /// False with an effect that this flow does not know.
  bool covers() const { return covers_; }

  /// The mode in which a moving drive goes on after its inputs were set from outside, where the torques are clear of
  /// the switching surface; otherwise the equations of core/ have to decide.
  std::optional<Mode> settle(const Instant& now) {
    if (now.x[1] == 0.0 || !has_teeth_ || !inputs_are_constant()) return std::nullopt;
    settled_arm_ = arm_at(now.x[0]);
    settled_at_ = now.x[0];
    const auto motion = now.x[1] > 0.0 ? wormdrive::Motion::forward : wormdrive::Motion::backward;
    const Equation& m = equations_[index(sign(motion), 1)];
    const double beyond = held_torques(m).beyond, lift = m.held.lift * settled_arm_.cosine,
                 skew = m.held.skew * now.x[1], distance = beyond - lift - skew;
    if (std::abs(distance) <= 1e-3 * (std::abs(beyond) + std::abs(lift) + std::abs(skew))) return std::nullopt;
    return Mode{motion, distance <= 0.0 ? Flank::left : Flank::right};
  }

  /// Takes up mode and inputs.
  void begin(const Instant& now) {
    // Modes outlast samples: a branch is foretold, an index would have to wait for the torque.
    if (now.mode != latest_) {
      latest_ = now.mode;
      mode_ = &equations_[index(sign(latest_.motion), sign(latest_.flank))];
    }
    constant_inputs_ = inputs_are_constant();
  }

  /// One step to next while the inputs are constant, where HeldMotion can vouch for it; otherwise nothing changes.
  bool leap(Instant& now, double next, const TaylorAccuracy& accuracy) const {
    if (!constant_inputs_) return false;
    if (!mode_->held.template leap<swings>(now.x[0], now.x[1], next - now.t, held_torques(*mode_), arm_at(now.x[0]),
                                           accuracy))
      return false;
    now.t = next;
    return true;
  }

  /// The motion from now on, accurate over a step of at most h.
  void expand(const Instant& now, double h, const TaylorAccuracy& accuracy, Motion& e) {
    const Equation& m = *mode_;
    input(motor_, now.t, accuracy.order(), worm_torque_);
    worm_torque_[0] += m.worm_friction;
    if constexpr (swings)
      turn_to(now.x[0] + load_.offset);
    else
      input(load_.piece, now.t, accuracy.order(), gear_torque_);
    gear_torque_[0] += m.gear_friction;

    e.theta[0] = now.x[0];
    e.omega[0] = now.x[1];
    const double allowed = accuracy.allowed(e.omega[0]);
    double power = 1.0 / h;  // h^(k-1)
    for (int k = 0;; ++k) {
      if constexpr (swings)
        if (k > 0) turn(e.omega, k);
      e.theta[k + 1] = e.omega[k] * reciprocal[k + 1];
      e.guards[System::speed_guard][k] = m.held.motion * e.omega[k];
      e.guards[System::flank_guard][k] =
          -m.held.flank * (worm_torque_[k] - surface_ * gear_torque_[k] - m.held.skew * e.omega[k]);
      if (k == 0 && m.held.flank == 0.0) e.guards[System::flank_guard][0] = 1.0;
      e.order = k;
      if (k == accuracy.order()) break;
      if (std::abs(e.omega[k]) * power <= allowed && accuracy.suffices(e, h)) {
        e.step = h;
        return;
      }
      power *= h;
      const double alpha =
          worm_torque_[k] * m.per_worm_torque + gear_torque_[k] * m.per_gear_torque - m.held.drag * e.omega[k];
      e.omega[k + 1] = alpha * reciprocal[k + 1];
    }
    e.step = accuracy.step(e, h);
  }

 private:
  /// Effects that inertias and inputs, as the system tells them, contain, and those that do not touch the motion.
  template <class E>
  static constexpr bool contained =
      std::is_same_v<E, TorqueSaturation<double>> || std::is_same_v<E, WormInertia<double>> ||
      std::is_same_v<E, GearInertia<double>> || E::place == Place::sensor;
  static constexpr bool swings = std::is_same_v<Load, GravityLoad>;
  using Pair = double __attribute__((vector_size(16)));  // two sums in one register

  /// A mode: theta'' = per_worm_torque tau_w + per_gear_torque tau_g - drag theta', its distance from the switching
  /// surface tau_w - (Jw i/Jg) tau_g - skew theta'; tau_w and tau_g hold the dry friction, not the viscous. All in SI.
  struct Equation {
    HeldMotion held;
    double per_worm_torque, per_gear_torque;
    double worm_friction, gear_friction;
  };

  static constexpr auto reciprocal = [] {
    std::array<double, highest_order + 3> r{};
    for (std::size_t k = 1; k < r.size(); ++k) r[k] = 1.0 / static_cast<double>(k);
    return r;
  }();

  static int index(int motion, int flank) { return (motion > 0 ? 3 : 0) + flank + 1; }
  static bool is_constant(const Piece& piece) { return piece.cosines.empty() && piece.slope == 0.0; }
  bool inputs_are_constant() const {
    if constexpr (swings)
      return is_constant(motor_);
    else
      return is_constant(motor_) && is_constant(load_.piece);
  }
  HeldTorques held_torques(const Equation& m) const {
    const double worm = motor_.constant + m.worm_friction;
    double gear = m.gear_friction;
    if constexpr (!swings) gear += load_.piece.constant;
    return {worm * m.per_worm_torque + gear * m.per_gear_torque, worm - surface_ * gear};
  }

  double amplitude() const {
    if constexpr (swings)
      return load_.amplitude;
    else
      return 0.0;
  }
  /// Sine and cosine of the arm's angle, worked out once for mode and motion.
  SineAndCosine arm_at(double theta_g) const {
    if constexpr (!swings)
      return {0.0, 0.0};
    else
      return theta_g == settled_at_ ? settled_arm_ : sine_and_cosine(theta_g + load_.offset);
  }

  /// Sets c to the coefficients of an input, up to the last that is asked for.
  static void input(const Piece& piece, double t, int last, Coefficients& c) {
    std::fill_n(c.begin(), last + 1, 0.0);
    c[0] = piece.constant + piece.slope * (t - piece.start);
    c[1] = piece.slope;
    for (const Cosine& wave : piece.cosines) {
      const SineAndCosine now = sine_and_cosine(wave.omega * t + wave.phase);
      const std::array<double, 4> derivatives{wave.amplitude * now.cosine, -wave.amplitude * now.sine,
                                              -wave.amplitude * now.cosine, wave.amplitude * now.sine};
      double weight = 1.0;  // omega^k / k!
      for (int k = 0; k <= last; ++k) {
        c[k] += weight * derivatives[k % 4];
        weight *= wave.omega * reciprocal[k + 1];
      }
    }
  }

  void turn_to(double angle) {
    const SineAndCosine start = sine_and_cosine(angle);
    arm_[0] = Pair{start.cosine, start.sine};
    gear_torque_[0] = load_.amplitude * start.cosine;
  }

  /// Coefficient k of cosine and sine: k cos_k = -sum of omega_(j-1) sin_(k-j), k sin_k = sum of omega_(j-1) cos_(k-j).
  /// Summed from the middle outwards: the factors that are known last come last, and two sums run side by side.
  void turn(const Coefficients& omega, int k) {
    Pair lower{0.0, 0.0}, upper{0.0, 0.0};
    if (k % 2 == 1) lower = omega[k / 2] * arm_[k / 2];
    for (int j = k / 2; j >= 1; --j) {
      lower += omega[j - 1] * arm_[k - j];
      upper += omega[k - j] * arm_[j - 1];
    }
    const Pair sum = (lower + upper) * reciprocal[k];
    arm_[k] = Pair{-sum[1], sum[0]};
    gear_torque_[k] = load_.amplitude * arm_[k][0];
  }

  const Piece& motor_;
  const Load& load_;
  double surface_;
  bool has_teeth_, covers_ = true;
  std::array<Equation, 6> equations_{};
  Mode latest_{};
  const Equation* mode_ = &equations_[0];  ///< that of the latest mode
  bool constant_inputs_ = false;
  Coefficients worm_torque_{}, gear_torque_{};                    ///< of the latest step, but for viscous friction
  std::array<Pair, highest_order + 2> arm_{};                     ///< cosine and sine of the arm's angle
  double settled_at_ = std::numeric_limits<double>::quiet_NaN();  ///< gear angle of the latest settle [rad]
  SineAndCosine settled_arm_{};
};

}  // namespace wormdrive
