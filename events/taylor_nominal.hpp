#pragma once
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

#include "core/load.hpp"
#include "core/worm_drive.hpp"
#include "events/sine_cosine.hpp"
#include "events/taylor_accuracy.hpp"

namespace wormdrive {

/// Bounds of derivatives of a motion theta'' = f + gamma cos(theta + offset) - drag theta', all of whose rates are
/// below sigma [1/s]: |theta^(k)| <= m_k sigma^k and |d^k cos/dt^k| <= mu_k sigma^k, from y'' = e^y + y'.
struct MotionBounds {
  std::array<double, highest_order + 2> remainder{};  ///< of the speed, cut behind theta^(n), for a step of 1/sigma

  constexpr MotionBounds() {
    constexpr int n = highest_order + 1;
    std::array<double, n + 2> m{}, mu{}, binomial{1.0};  // binomial: row k - 1 of Pascal's triangle
    m[1] = m[2] = mu[0] = 1.0;
    double factorial = 1.0;
    for (int k = 1; k <= n; ++k) {
      for (int j = 1; j <= k; ++j) mu[k] += binomial[j - 1] * m[j] * mu[k - j];
      for (int j = k; j >= 1; --j) binomial[j] += binomial[j - 1];
      if (k + 2 <= n + 1) m[k + 2] = mu[k] + m[k + 1];
      factorial *= k;
      remainder[k] = (mu[k - 1] > m[k] ? mu[k - 1] : m[k]) / factorial;
    }
  }
};
inline constexpr MotionBounds motion_bounds{};

template <class System>
inline constexpr bool has_closed_form = false;
template <>
inline constexpr bool has_closed_form<WormDrive<double, GravityLoad>> = true;
template <>
inline constexpr bool has_closed_form<WormDrive<double, TimedLoad>> = true;

/// The motion of a drive with nothing but an arm under gravity or a load over time and dry and viscous bearings, by
/// formulas of its own: what TracedFlow does for any drive, some ten times faster.
template <class Load>
class NominalFlow {
 public:
  using System = WormDrive<double, Load>;
  using Instant = typename System::Instant;

  /// The system must outlive the flow; its inputs may change between calls of begin, its parameters must not.
  explicit NominalFlow(const System& system)
      : motor_(system.motor_piece()), load_(system.load()), surface_(system.surface()) {
    double worm_coulomb = 0.0, gear_coulomb = 0.0;
    system.effects().for_each([&]<class E>(const std::optional<E>& effect) {
      if (!effect) return;
      if constexpr (std::is_same_v<E, WormCoulomb<double>>) worm_coulomb = effect->torque;
      else if constexpr (std::is_same_v<E, GearCoulomb<double>>) gear_coulomb = effect->torque;
      else if constexpr (std::is_same_v<E, WormViscous<double>>) worm_drag_ = effect->coefficient * system.mesh().i;
      else if constexpr (std::is_same_v<E, GearViscous<double>>) gear_drag_ = effect->coefficient;
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
        b.friction = (b.worm_friction + b.C * b.gear_friction) * b.inverse;
        b.drag = (worm_drag_ + b.C * gear_drag_) * b.inverse;
        if constexpr (gravity) b.gravity = b.C * load_.amplitude * b.inverse;
      }
  }

  /// False with an effect that this flow does not know.
  bool covers() const { return covers_; }

  /// Takes up mode and inputs.
  void begin(const System&, const Instant& now) {
    motion_ = sign(now.mode.motion);
    flank_ = sign(now.mode.flank);
    branch_ = &branches_[index(motion_, flank_)];
    held_ = held(motor_);
    push_ = motor_.constant * branch_->inverse;
    steady_ = branch_->friction;
    beyond_ = motor_.constant + branch_->worm_friction - surface_ * branch_->gear_friction;
    if constexpr (!gravity) {
      held_ = held_ && held(load_.piece);
      steady_ += branch_->C * load_.piece.constant * branch_->inverse;
      beyond_ -= surface_ * load_.piece.constant;
    }
  }

  /// One step to next with inputs that are held, if it is certain beforehand that no guard falls through zero in it
  /// and how far the series must go. False otherwise; then nothing has changed.
  bool leap(Instant& now, double next, const TaylorAccuracy& accuracy) const {
    if (!held_) return false;
    const Branch& b = *branch_;
    const double h = next - now.t, v = now.x[1], drag = std::abs(b.drag);
    // Bounds of acceleration and speed within the step.
    const double alpha = (std::abs(push_) + std::abs(steady_) + std::abs(b.gravity) + drag * std::abs(v)) * (1.0 + 2.0 * drag * h) * 1.000001;
    const double omega = std::abs(v) + alpha * h;
    if (!(motion_ * v > alpha * h) || drag * h > 0.5) return false;
    const Phase phase = phase_at(now.x[0]);
    if (flank_ != 0) {
      const double beyond = beyond_ - surface_ * (load_amplitude() * phase.cosine) - skew() * v;
      const double change = (surface_ * std::abs(load_amplitude()) * omega + std::abs(skew()) * alpha) * h;
      if (!(-flank_ * beyond > change)) return false;
    }
    const double sigma = std::sqrt(omega * omega + alpha + drag * drag), reach = h * sigma;
    const double rate = std::abs(b.gravity) + drag * sigma;
    return follow<4>(now, next, phase, rate * (reach * reach * reach), reach, accuracy.allowed(omega));
  }

  /// The motion from now on, accurate over a step of at most h.
  void expand(const System&, const Instant& now, double h, const TaylorAccuracy& accuracy,
              Expansion<System::guard_count>& e) {
    const int proven = order_within(now, h, accuracy);
    e.order = proven ? proven : accuracy.order;
    series(now, e);
    e.step = proven ? h : accuracy.step(e.speed(), h);
  }

 private:
  static constexpr bool gravity = std::is_same_v<Load, GravityLoad>;
  static constexpr int longest_leap = 9;

  struct Branch {
    double C, inverse, worm_friction, gear_friction, friction, drag, gravity = 0.0;
  };
  struct Phase {
    double sine = 0.0, cosine = 0.0;
  };

  static int index(int motion, int flank) { return (motion > 0 ? 3 : 0) + flank + 1; }
  static bool held(const Piece& piece) { return piece.cosines.empty() && piece.slope == 0.0; }
  double load_amplitude() const {
    if constexpr (gravity) return load_.amplitude;
    else return 0.0;
  }
  /// How the distance from the switching surface falls with the speed.
  double skew() const { return worm_drag_ - surface_ * gear_drag_; }
  Phase phase_at(double theta) const {
    if constexpr (gravity) {
      const SineAndCosine now = sine_and_cosine(theta + load_.offset);
      return {now.sine, now.cosine};
    } else {
      return {};
    }
  }

  /// The step with the derivatives of the angle up to the N-th or, if that is not accurate enough, to a later one.
  template <int N>
  bool follow(Instant& now, double next, const Phase& phase, double remainder, double reach, double allowed) const {
    if (remainder * motion_bounds.remainder[N] > allowed) {
      if constexpr (N < longest_leap) return follow<N + 1>(now, next, phase, remainder * reach, reach, allowed);
      return false;
    }
    const double h = next - now.t;
    std::array<double, N + 1> x;  // derivatives of the angle
    std::array<double, N> cosine, sine;
    x[1] = now.x[1];
    x[2] = push_ + (steady_ + branch_->gravity * phase.cosine - branch_->drag * x[1]);
    cosine[0] = phase.cosine;
    sine[0] = phase.sine;
#pragma GCC unroll 16
    for (int k = 1; k + 2 <= N; ++k) {
      if constexpr (gravity) {
        // the factors that are known last come last
        double turned = x[1] * sine[k - 1], lifted = x[1] * cosine[k - 1], binomial = 1.0;  // (k - 1 over j - 1)
        if (k > 1) {
          double s = (k - 1) * x[2] * sine[k - 2], c = (k - 1) * x[2] * cosine[k - 2];
          binomial = k - 1;
#pragma GCC unroll 16
          for (int j = 3; j <= k; ++j) {
            binomial = binomial * (k - j + 1) / (j - 1);
            s += binomial * x[j] * sine[k - j];
            c += binomial * x[j] * cosine[k - j];
          }
          turned = s + turned;
          lifted = c + lifted;
        }
        cosine[k] = -turned;
        sine[k] = lifted;
        x[k + 2] = -branch_->gravity * turned - branch_->drag * x[k + 1];
      } else {
        x[k + 2] = -branch_->drag * x[k + 1];
      }
    }
    double weight = 0.5 * h * h, speed = x[3] * weight, angle = x[3] * (weight * (h * (1.0 / 3.0)));  // h^k / k!
#pragma GCC unroll 16
    for (int k = 3; k < N; ++k) {
      weight *= h * (1.0 / k);
      speed += x[k + 1] * weight;
      angle += x[k + 1] * (weight * (h * (1.0 / (k + 1))));
    }
    now.x[0] += x[1] * h + (x[2] * (0.5 * h * h) + angle);
    now.x[1] += x[2] * h + speed;
    now.t = next;
    return true;
  }

  /// The order of the speed that is enough for a step of h, by the bounds of its derivatives; 0 if none is.
  int order_within(const Instant& now, double h, const TaylorAccuracy& accuracy) const {
    const Branch& b = *branch_;
    const double v = now.x[1], drag = std::abs(b.drag);
    if (drag * h > 0.5) return 0;
    double waves = 0.0, slopes = 0.0, fastest = 0.0, held = std::abs(b.worm_friction) + std::abs(b.C * b.gear_friction);
    const auto bound = [&](const Piece& piece, double factor) {
      slopes += factor * std::abs(piece.slope);
      held += factor * std::abs(piece.constant + piece.slope * (now.t - piece.start));
      for (const Cosine& c : piece.cosines) waves += factor * std::abs(c.amplitude);
      fastest = std::max(fastest, piece.fastest());
    };
    bound(motor_, 1.0);
    if constexpr (!gravity) bound(load_.piece, std::abs(b.C));
    const double force = (held + waves + slopes * h) * b.inverse, jerk = slopes * b.inverse;
    const double alpha = (force + std::abs(b.gravity) + drag * std::abs(v)) * (1.0 + 2.0 * drag * h);
    const double omega = std::abs(v) + alpha * h;
    double sigma = std::sqrt(omega * omega + alpha + drag * drag + fastest * fastest);
    while (sigma * sigma * sigma < jerk) sigma *= 1.25;
    const double reach = h * sigma, rate = std::abs(b.gravity) + waves * b.inverse + drag * sigma;
    double remainder = rate * reach * reach * reach;
    for (int n = 4; n <= accuracy.order; ++n, remainder *= reach)
      if (remainder * motion_bounds.remainder[n] <= accuracy.allowed(v)) return n - 1;
    return 0;
  }

  /// Adds the coefficients of an input to c, times a factor.
  static void add(const Piece& piece, double t, int order, Coefficients& c) {
    c[0] += piece.constant + piece.slope * (t - piece.start);
    c[1] += piece.slope;
    for (const Cosine& wave : piece.cosines) {
      const SineAndCosine now = sine_and_cosine(wave.omega * t + wave.phase);
      const double square = -wave.omega * wave.omega;
      double even = wave.amplitude * now.cosine, odd = -wave.amplitude * wave.omega * now.sine;
      for (int k = 0; k <= order; k += 2) {
        c[k] += even;
        c[k + 1] += odd;
        even *= square * per_index.two[k];
        odd *= square * per_index.two[k + 1];
      }
    }
  }

  void series(const Instant& now, Expansion<System::guard_count>& e) const {
    const Branch& b = *branch_;
    const int order = e.order;
    std::fill_n(torque_.begin(), order + 2, 0.0);
    add(motor_, now.t, order, torque_);
    torque_[0] += b.worm_friction;
    if constexpr (!gravity) {
      std::fill_n(load_torque_.begin(), order + 2, 0.0);
      add(load_.piece, now.t, order, load_torque_);
    }
    e.theta[0] = now.x[0];
    e.omega[0] = now.x[1];
    const double inverse = b.inverse, inverse_C = b.C * inverse;
    const Phase phase = phase_at(now.x[0]);
    // cosine and sine of the arm's angle
    std::array<Pair, most_coefficients> arm;
    arm[0] = Pair{phase.cosine, phase.sine};
    if constexpr (gravity) load_torque_[0] = load_.amplitude * phase.cosine;
    load_torque_[0] += b.gear_friction;
    e.omega[1] = torque_[0] * inverse + inverse_C * load_torque_[0] - b.drag * e.omega[0];
    for (int k = 1; k <= order; ++k) {
      if constexpr (gravity) {
        // The factors that are known last come last, and two sums run side by side.
        Pair sum{0.0, 0.0}, other{0.0, 0.0};
        int j = 2;
        for (; j < k; j += 2) {
          sum += e.omega[j - 1] * arm[k - j];
          other += e.omega[j] * arm[k - j - 1];
        }
        if (j == k) sum += e.omega[j - 1] * arm[0];
        sum = (sum + other + e.omega[0] * arm[k - 1]) * per_index.one[k];
        arm[k] = Pair{-sum[1], sum[0]};
        load_torque_[k] = -load_.amplitude * sum[1];
      }
      e.omega[k + 1] = (torque_[k] * inverse + inverse_C * load_torque_[k] - b.drag * e.omega[k]) * per_index.one[k + 1];
    }
    for (int k = 0; k <= order; ++k) {
      e.theta[k + 1] = e.omega[k] * per_index.one[k + 1];
      e.guards[System::speed_guard][k] = motion_ * e.omega[k];
      e.guards[System::flank_guard][k] = -flank_ * (torque_[k] - surface_ * load_torque_[k] - skew() * e.omega[k]);
    }
    if (flank_ == 0) e.guards[System::flank_guard][0] = 1.0;
  }

  /// 1/k and 1/((k + 1)(k + 2)).
  struct PerIndex {
    std::array<double, most_coefficients + 2> one{}, two{};
    constexpr PerIndex() {
      for (std::size_t k = 1; k < one.size(); ++k) one[k] = 1.0 / static_cast<double>(k);
      for (std::size_t k = 0; k < two.size(); ++k) two[k] = 1.0 / static_cast<double>((k + 1) * (k + 2));
    }
  };
  static constexpr PerIndex per_index{};
  using Pair = double __attribute__((vector_size(16)));

  mutable Coefficients torque_{}, load_torque_{};
  const Piece& motor_;
  const Load& load_;
  double surface_, worm_drag_ = 0.0, gear_drag_ = 0.0;
  std::array<Branch, 6> branches_{};
  bool covers_ = true, held_ = false;
  const Branch* branch_ = &branches_[0];
  int motion_ = 0, flank_ = 0;
  double push_ = 0.0, steady_ = 0.0, beyond_ = 0.0;
};

}  // namespace wormdrive
