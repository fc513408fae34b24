#pragma once
#include <array>
#include <cmath>
#include <numbers>

// of libquadmath; its header is GCC's alone, and other tools read this file too
extern "C" {
__float128 fabsq(__float128);
__float128 cosq(__float128);
__float128 sinq(__float128);
}

namespace bench {

using std::abs, std::cos, std::sin;
using Quad = __float128;
inline Quad abs(Quad x) { return fabsq(x); }
inline Quad cos(Quad x) { return cosq(x); }
inline Quad sin(Quad x) { return sinq(x); }

/// Inputs of a drive [N m, rad/s, rad]: what a program written for one case has as constants.
struct Case {
  double load_cosine = 0.0, load_sine = 0.0;     ///< tau_l = load_cosine cos(theta_g) or load_sine sin(theta_g)
  double motor = 0.0, omega = 0.0, phase = 0.0;  ///< tau_m = motor cos(omega t + phase) + what is held
};
inline constexpr double pi = std::numbers::pi;
/// Fig. 9.
inline constexpr Case open_loop{.load_cosine = 0.0196, .motor = 0.05, .omega = 3 * pi, .phase = pi / 2};
/// The actual load of fig. 10.
inline constexpr Case closed_loop{.load_sine = 0.0176};

enum class Mode { stuck, forward_left, forward_right, backward_left, backward_right };

constexpr int motion(Mode mode) {
  switch (mode) {
    case Mode::stuck: return 0;
    case Mode::forward_left:
    case Mode::forward_right: return 1;
    case Mode::backward_left:
    case Mode::backward_right: return -1;
  }
  return 0;
}
constexpr int flank(Mode mode) {
  switch (mode) {
    case Mode::stuck: return 0;
    case Mode::forward_left:
    case Mode::backward_left: return 1;
    case Mode::forward_right:
    case Mode::backward_right: return -1;
  }
  return 0;
}
constexpr Mode other_flank(Mode mode) {
  switch (mode) {
    case Mode::stuck: return Mode::stuck;
    case Mode::forward_left: return Mode::forward_right;
    case Mode::forward_right: return Mode::forward_left;
    case Mode::backward_left: return Mode::backward_right;
    case Mode::backward_right: return Mode::backward_left;
  }
  return Mode::stuck;
}

/// The drive of Table 1 as one would program it for one case alone: constants worked out once, one switch per question,
/// nothing of wormdrive. Equation numbers are those of Yeh & Wu 2009.
template <Case inputs, class R>
class Plant {
 public:
  using Real = R;
  static constexpr Case given = inputs;
  using State = std::array<Real, 2>;  ///< theta_g [rad], theta_g' [rad/s]

  Mode mode = Mode::stuck;
  Real held = 0;         ///< the motor torque of a controller [N m]
  long evaluations = 0;  ///< of the derivative

  Real motor_torque(Real t) const {
    if constexpr (inputs.motor == 0.0)
      return held;
    else
      return held + Real(inputs.motor) * cos(Real(inputs.omega) * t + Real(inputs.phase));
  }
  static Real load_torque(Real theta) {
    if constexpr (inputs.load_cosine != 0.0)
      return Real(inputs.load_cosine) * cos(theta);
    else
      return Real(inputs.load_sine) * sin(theta);
  }
  static Real load_slope(Real theta) {
    if constexpr (inputs.load_cosine != 0.0)
      return -Real(inputs.load_cosine) * sin(theta);
    else
      return Real(inputs.load_sine) * cos(theta);
  }

  /// Eq. 18-19.
  Real acceleration(Mode in, Real tau_m, Real tau_l) const {
    switch (in) {
      case Mode::stuck: return 0;
      case Mode::forward_left:
      case Mode::backward_right: return (tau_m + C1 * tau_l) / J1;
      case Mode::forward_right:
      case Mode::backward_left: return (tau_m + C2 * tau_l) / J2;
    }
    return 0;
  }
  void derivative(Real t, const Real* y, Real* rate) {
    ++evaluations;
    rate[0] = y[1];
    rate[1] = acceleration(mode, motor_torque(t), load_torque(y[0]));
  }
  /// Speed in its direction and distance to the switching surface: both fall through zero when the mode ends.
  void roots(Real t, const Real* y, Real* g) const {
    g[0] = motion(mode) * y[1];
    g[1] = -flank(mode) * (motor_torque(t) - surface * load_torque(y[0]));
  }

  /// The mode in which the torques move the gear from rest, stuck if they do not.
  Mode from_rest(Real t, Real theta) const {
    const Real tau_m = motor_torque(t), tau_l = load_torque(theta);
    const bool left = tau_m <= surface * tau_l;
    const Mode forward = left ? Mode::forward_left : Mode::forward_right;
    const Mode backward = left ? Mode::backward_left : Mode::backward_right;
    if (acceleration(forward, tau_m, tau_l) > 0) return forward;
    if (acceleration(backward, tau_m, tau_l) < 0) return backward;
    return Mode::stuck;
  }
  /// The mode after the held torque has jumped.
  Mode settle(Real t, const State& y) const {
    if (y[1] == 0) return from_rest(t, y[0]);
    const bool left = motor_torque(t) <= surface * load_torque(y[0]);
    if (y[1] > 0) return left ? Mode::forward_left : Mode::forward_right;
    return left ? Mode::backward_left : Mode::backward_right;
  }

  /// Eq. 6-7 at rest, 12 and 14 in motion [N].
  Real normal_force(Real tau_m, Real tau_l, Real alpha) const {
    const Real gear = tau_l - Jg * alpha;
    switch (mode) {
      case Mode::stuck: return abs(tau_l / lg * cos_lambda - tau_m / lw * sin_lambda) / cos_phi;
      case Mode::forward_left: return gear / (lever_1 * lg);
      case Mode::backward_right: return -gear / (lever_1 * lg);
      case Mode::forward_right: return -gear / (lever_2 * lg);
      case Mode::backward_left: return gear / (lever_2 * lg);
    }
    return 0;
  }

 protected:
  // Table 1; 1 where motion and flank have one sign (forward left, backward right), 2 where they differ
  static constexpr double degree = pi / 180.0, lw = 0.011, lg = 0.045, mu = 0.25, Jg = 7.39e-4;
  const Real Jw_i = Real(2.53e-5) * 60;
  const Real cos_lambda = cos(Real(4 * degree)), sin_lambda = sin(Real(4 * degree)), cos_phi = cos(Real(20 * degree));
  const Real lever_1 = cos_phi * cos_lambda + mu * sin_lambda, lever_2 = cos_phi * cos_lambda - mu * sin_lambda;

 public:
  const Real C1 = Real(lw) / lg * (cos_phi * sin_lambda - mu * cos_lambda) / lever_1;
  const Real C2 = Real(lw) / lg * (cos_phi * sin_lambda + mu * cos_lambda) / lever_2;
  const Real J1 = Jw_i + C1 * Jg, J2 = Jw_i + C2 * Jg, surface = Jw_i / Jg;
};

}  // namespace bench
