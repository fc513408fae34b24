#pragma once
// A rigid drive and its inputs as plain numbers: what the judge and the program are both given.
#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace judge {

/// One term of a torque over time [N m]. A sinusoid is size cos(rate t + phase), a ramp size (t - begin) to its end.
struct Term {
  enum class Kind { constant, sinusoid, ramp, step } kind = Kind::constant;
  double size = 0.0;                                     ///< torque or amplitude [N m], of a ramp [N m/s]
  double frequency = 0.0, phase = 0.0;                   ///< of a sinusoid [Hz, rad]
  double begin = 0.0;                                    ///< of a ramp or a step [s]
  double end = std::numeric_limits<double>::infinity();  ///< of a ramp [s]

  /// In rad/s: the double that a frequency in Hz becomes is what is given.
  double rate() const { return 2.0 * std::numbers::pi * frequency; }
};
using Torque = std::vector<Term>;

inline Term constant(double torque) { return {.size = torque}; }
inline Term sinusoid(double amplitude, double frequency, double phase) {
  return {.kind = Term::Kind::sinusoid, .size = amplitude, .frequency = frequency, .phase = phase};
}
inline Term step(double torque, double time) { return {.kind = Term::Kind::step, .size = torque, .begin = time}; }
inline Term ramp(double rate, double begin, double end) {
  return {.kind = Term::Kind::ramp, .size = rate, .begin = begin, .end = end};
}

/// First time after t at which a torque jumps or bends [s].
inline double next_knot(const Torque& torque, double t) {
  double next = std::numeric_limits<double>::infinity();
  for (const Term& term : torque) {
    if (term.kind != Term::Kind::ramp && term.kind != Term::Kind::step) continue;
    if (term.begin > t) next = std::min(next, term.begin);
    if (term.kind == Term::Kind::ramp && term.end > t) next = std::min(next, term.end);
  }
  return next;
}

// Effects, each by the law of docs/effects.md; the names are those of the paper and of that page.
struct Cogging {
  double amplitude, periods, phase;
};
struct BearingAsymmetry {
  double torque, coefficient;
};
struct Stribeck {
  double drop, speed;
};
struct StaticFriction {
  double rise, growth_time;
};
struct LoadSpring {
  double stiffness, angle;
};
struct TransmissionError {
  double amplitude, phase;
};
struct GravityArm {
  double amplitude, offset, inertia;
};

struct Drive {
  bool teeth = true;  ///< false: a single inertia Jg, all else of the mesh is not used
  double i = 60, lambda = 0, phi_n = 0, lw = 0, lg = 0, mu = 0, Jw = 0, Jg = 0;
  Torque motor, load;
  std::optional<GravityArm> arm;  ///< in place of the load over time
  std::optional<double> torque_gain, torque_offset, worm_coulomb, worm_viscous, gear_coulomb, gear_viscous,
      friction_asymmetry;
  std::optional<Cogging> cogging;
  std::optional<BearingAsymmetry> bearing_asymmetry;
  std::optional<Stribeck> stribeck;
  std::optional<StaticFriction> static_friction;
  std::optional<LoadSpring> load_spring;
  std::optional<TransmissionError> transmission_error;
  double theta = 0.0, omega = 0.0;  ///< of the gear at the start [rad, rad/s]
  double end = 0.0;                 ///< of the run [s]
};

/// Direction of motion, +1, 0 or -1, and flank, +1 left, -1 right, 0 at rest and without teeth.
struct Mode {
  int motion = 0, flank = 0;
  friend bool operator==(const Mode&, const Mode&) = default;
};

struct Event {
  double t;
  Mode before, after;
};

}  // namespace judge
