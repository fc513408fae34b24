#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <type_traits>

#include "core/load.hpp"
#include "core/worm_drive.hpp"
#include "events/sine_cosine.hpp"
#include "events/taylor_accuracy.hpp"
#include "events/taylor_bounds.hpp"
#include "events/taylor_leap.hpp"

namespace wormdrive {

/// The motion of a drive with nothing but an arm under gravity or a load over time and dry and viscous bearings, by
/// formulas of its own: what TracedFlow finds for any drive, ten times faster.
template <class Load>
class NominalFlow {
 public:
  using System = WormDrive<double, Load>;
  using Instant = typename System::Instant;
  using Series = Expansion<System::guard_count>;

  /// The system must outlive the flow; its inputs may change between calls of begin, its parameters must not.
  explicit NominalFlow(const System& system)
      : motor_(system.motor_piece()), load_(system.load()), surface_(system.surface()) {
    double worm_coulomb = 0.0, gear_coulomb = 0.0, worm_viscous = 0.0, gear_viscous = 0.0;
    system.effects().for_each([&]<class E>(const std::optional<E>& effect) {
      if (!effect) return;
      if constexpr (std::is_same_v<E, WormCoulomb<double>>) worm_coulomb = effect->torque;
      else if constexpr (std::is_same_v<E, GearCoulomb<double>>) gear_coulomb = effect->torque;
      else if constexpr (std::is_same_v<E, WormViscous<double>>) worm_viscous = effect->coefficient * system.mesh().i;
      else if constexpr (std::is_same_v<E, GearViscous<double>>) gear_viscous = effect->coefficient;
      else if constexpr (E::place != Place::actuator && E::place != Place::sensor) covers_ = false;
    });
    const GearMesh<double>& mesh = system.mesh();
    for (int motion : {-1, 1})
      for (int flank : {-1, 0, 1}) {
        Branch& b = branches_[index(motion, flank)];
        b.C = mesh.C(motion * flank * mesh.mu);
        b.inverse = 1.0 / (mesh.Jw * mesh.i + b.C * system.Jg());
        b.worm_friction = -motion * worm_coulomb;
        b.gear_friction = -motion * gear_coulomb;
        b.held.motion = motion;
        b.held.flank = flank;
        b.held.per_torque = b.inverse;
        b.held.drag = (worm_viscous + b.C * gear_viscous) * b.inverse;
        b.held.skew = worm_viscous - surface_ * gear_viscous;
        if constexpr (swings) {
          b.held.gravity = b.C * load_.amplitude * b.inverse;
          b.held.offset = load_.offset;
          b.held.lift = surface_ * load_.amplitude;
        }
      }
  }

  /// False with an effect that this flow does not know.
  bool covers() const { return covers_; }

  /// Takes up mode and inputs.
  void begin(const System&, const Instant& now) {
    branch_ = &branches_[index(sign(now.mode.motion), sign(now.mode.flank))];
    Branch& b = *branch_;
    held_ = held(motor_);
    double gear = b.gear_friction;
    if constexpr (!swings) {
      held_ = held_ && held(load_.piece);
      gear += load_.piece.constant;
    }
    b.held.steady = (b.worm_friction + b.C * gear) * b.inverse;
    b.held.short_of = surface_ * gear - b.worm_friction;
  }

  /// One step to next while the inputs are constant, where HeldMotion can vouch for it; otherwise nothing changes.
  bool leap(Instant& now, double next, const TaylorAccuracy& accuracy) const {
    if (!held_) return false;
    if (!branch_->held.template leap<swings>(now.x[0], now.x[1], next - now.t, motor_.constant, accuracy)) return false;
    now.t = next;
    return true;
  }

  /// The motion from now on, accurate over a step of at most h.
  void expand(const System&, const Instant& now, double h, const TaylorAccuracy& accuracy, Series& e) {
    const int proven = order_within(now, h, accuracy);
    e.order = proven > 0 ? proven : accuracy.order;
    motion(now, e);
    guards(e);
    e.step = proven > 0 ? h : accuracy.step(e.speed(), h);
  }

 private:
  static constexpr bool swings = std::is_same_v<Load, GravityLoad>;
  using Pair = double __attribute__((vector_size(16)));  // two sums in one register

  /// What a mode makes of the parameters.
  struct Branch {
    double C, inverse;  ///< torque ratio and 1/(Jw i + C Jg)
    double worm_friction, gear_friction;
    HeldMotion held;
  };

  static int index(int motion, int flank) { return (motion > 0 ? 3 : 0) + flank + 1; }
  static bool held(const Piece& piece) { return piece.cosines.empty() && piece.slope == 0.0; }

  /// The order of the speed that is certainly enough for a step of h; 0 if none is.
  int order_within(const Instant& now, double h, const TaylorAccuracy& accuracy) const {
    const Branch& b = *branch_;
    const double v = std::abs(now.x[1]), damping = std::abs(b.held.drag), swing = std::abs(b.held.gravity);
    if (damping * h > 0.5) return 0;
    double waves = 0.0, slopes = 0.0, fastest = 0.0, rest = std::abs(b.worm_friction) + std::abs(b.C * b.gear_friction);
    const auto add_bounds = [&](const Piece& piece, double factor) {
      slopes += factor * std::abs(piece.slope);
      rest += factor * std::abs(piece.constant + piece.slope * (now.t - piece.start));
      for (const Cosine& c : piece.cosines) waves += factor * std::abs(c.amplitude);
      fastest = std::max(fastest, piece.fastest());
    };
    add_bounds(motor_, 1.0);
    if constexpr (!swings) add_bounds(load_.piece, std::abs(b.C));
    const double force = (rest + waves + slopes * h) * b.inverse;
    const double alpha = (force + swing + damping * v) * (1.0 + 2.0 * damping * h), omega = v + alpha * h;
    double sigma = std::sqrt(omega * omega + alpha + damping * damping + fastest * fastest);
    while (sigma * sigma * sigma < slopes * b.inverse) sigma *= 1.25;
    const double reach = h * sigma;
    double error = (swing + waves * b.inverse + damping * sigma) * (reach * reach * reach);
    for (int n = 4; n <= accuracy.order; ++n, error *= reach)
      if (error * motion_bounds.remainder(n) <= accuracy.allowed(v)) return n - 1;
    return 0;
  }

  /// Sets c to the coefficients of an input.
  static void input(const Piece& piece, double t, int order, Coefficients& c) {
    std::fill_n(c.begin(), order + 2, 0.0);
    c[0] = piece.constant + piece.slope * (t - piece.start);
    c[1] = piece.slope;
    for (const Cosine& wave : piece.cosines) {
      const SineAndCosine now = sine_and_cosine(wave.omega * t + wave.phase);
      const double square = -wave.omega * wave.omega;
      double even = wave.amplitude * now.cosine, odd = -wave.amplitude * wave.omega * now.sine;
      for (int k = 0; k <= order; k += 2) {
        c[k] += even;
        c[k + 1] += odd;
        even *= square * reciprocal_.two[k];
        odd *= square * reciprocal_.two[k + 1];
      }
    }
  }

  /// The series of angle and speed, with those of the torques on both sides.
  void motion(const Instant& now, Series& e) {
    const Branch& b = *branch_;
    const double gear = b.C * b.inverse, drag = b.held.drag;
    input(motor_, now.t, e.order, worm_torque_);
    worm_torque_[0] += b.worm_friction;
    std::array<Pair, most_coefficients> arm;  // cosine and sine of its angle
    if constexpr (swings) {
      const SineAndCosine start = sine_and_cosine(now.x[0] + load_.offset);
      arm[0] = Pair{start.cosine, start.sine};
      gear_torque_[0] = load_.amplitude * start.cosine;
    } else {
      input(load_.piece, now.t, e.order, gear_torque_);
    }
    gear_torque_[0] += b.gear_friction;
    e.theta[0] = now.x[0];
    e.theta[1] = e.omega[0] = now.x[1];
    e.omega[1] = worm_torque_[0] * b.inverse + gear * gear_torque_[0] - drag * e.omega[0];
    for (int k = 1; k <= e.order; ++k) {
      if constexpr (swings) {
        arm[k] = turned(e.omega, arm, k);
        gear_torque_[k] = load_.amplitude * arm[k][0];
      }
      e.theta[k + 1] = e.omega[k] * reciprocal_.one[k + 1];
      e.omega[k + 1] =
          (worm_torque_[k] * b.inverse + gear * gear_torque_[k] - drag * e.omega[k]) * reciprocal_.one[k + 1];
    }
  }

  /// Coefficient k of cosine and sine: k cos_k = -sum of omega_(j-1) sin_(k-j), k sin_k = sum of omega_(j-1) cos_(k-j).
  /// The factors that are known last come last, and two sums run side by side.
  static Pair turned(const Coefficients& omega, const std::array<Pair, most_coefficients>& arm, int k) {
    Pair sum{0.0, 0.0}, other{0.0, 0.0};
    int j = 2;
    for (; j < k; j += 2) {
      sum += omega[j - 1] * arm[k - j];
      other += omega[j] * arm[k - j - 1];
    }
    if (j == k) sum += omega[j - 1] * arm[0];
    sum = (sum + other + omega[0] * arm[k - 1]) * reciprocal_.one[k];
    return Pair{-sum[1], sum[0]};
  }

  void guards(Series& e) const {
    const HeldMotion& held = branch_->held;
    for (int k = 0; k <= e.order; ++k) {
      e.guards[System::speed_guard][k] = held.motion * e.omega[k];
      e.guards[System::flank_guard][k] =
          -held.flank * (worm_torque_[k] - surface_ * gear_torque_[k] - held.skew * e.omega[k]);
    }
    if (held.flank == 0.0) e.guards[System::flank_guard][0] = 1.0;
  }

  /// 1/k and 1/((k + 1)(k + 2)).
  struct Reciprocals {
    std::array<double, most_coefficients + 2> one{}, two{};
    constexpr Reciprocals() {
      for (std::size_t k = 1; k < one.size(); ++k) one[k] = 1.0 / static_cast<double>(k);
      for (std::size_t k = 0; k < two.size(); ++k) two[k] = 1.0 / static_cast<double>((k + 1) * (k + 2));
    }
  };
  static constexpr Reciprocals reciprocal_{};

  const Piece& motor_;
  const Load& load_;
  double surface_;
  std::array<Branch, 6> branches_{};
  bool covers_ = true, held_ = false;
  Branch* branch_ = &branches_[0];
  Coefficients worm_torque_{}, gear_torque_{};  ///< of the latest step, but for viscous friction
};

/// Drives whose motion NominalFlow knows.
template <class System>
struct ClosedForm {
  static constexpr bool known = false;
  struct Flow {
    explicit Flow(const System&) {}
    static constexpr bool covers() { return false; }
    void begin(const System&, const auto&) {}
    void expand(const auto&...) {}
  };
};
template <class Load>
  requires(std::is_same_v<Load, GravityLoad> || std::is_same_v<Load, TimedLoad>)
struct ClosedForm<WormDrive<double, Load>> {
  static constexpr bool known = true;
  using Flow = NominalFlow<Load>;
};

}  // namespace wormdrive
