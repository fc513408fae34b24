#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/mode.hpp"
#include "core/moment.hpp"

namespace wormdrive {

/// Angle and speed of a shaft [rad, rad/s].
struct ShaftState {
  double angle{}, speed{};
};

/// A shaft under a constant torque.
struct ConstantAcceleration {
  double acceleration{};  ///< [rad/s^2]

  void move(ShaftState& shaft, double h) const {
    shaft.angle += h * (shaft.speed + 0.5 * h * acceleration);
    shaft.speed += h * acceleration;
  }
};

/// When teeth meet, which, and how fast they approach [rad/s at the gear].
struct Impact {
  double after;  ///< [s]
  Flank flank;
  double speed;
};

/// Both shafts in the gap over a short time.
struct FreeFlight {
  ConstantAcceleration gear, worm;  ///< the worm counted at the gear
  double closing;                   ///< speed of the gear against the worm at the start [rad/s]
  double duration{};                ///< for which this holds [s]

  double closing_acceleration() const { return gear.acceleration - worm.acceleration; }  ///< [rad/s^2]

  /// Slower it is no impact [rad/s]: teeth that have just parted, in a flight over which what presses them changes
  /// sign.
  static constexpr double least_speed = 1e-6;

  /// The first impact within the duration. play: of the gear against the worm at the start [rad]; half: of the gap.
  std::optional<Impact> impact(double separation, double half) const {
    std::optional<Impact> first;
    for (const Flank flank : {Flank::left, Flank::right}) {
      const double side = sign(flank), a = side * closing_acceleration(), v = side * closing;
      const double before = std::min(0.0, side * separation - half);  // what was touched a moment ago is touched
      const double square = v * v - 2.0 * a * before;
      if (!(square > 0.0) || (v <= 0.0 && a <= 0.0)) continue;  // they do not approach each other
      const double speed = std::sqrt(square);
      if (speed < least_speed) continue;
      const double after = v > 0.0 ? -2.0 * before / (v + speed) : (speed - v) / a;
      if (!(after >= 0.0) || after > duration || (first && first->after <= after)) continue;
      first = Impact{after, flank, speed};
    }
    return first;
  }
};

/// The acceleration of a shaft with dry friction: torque(motion) over an inertia; 0 where friction holds it.
template <class Torque>
double free_acceleration(double speed, double inertia, Torque&& torque) {
  if (speed != 0.0) return torque(speed > 0.0 ? Motion::forward : Motion::backward) / inertia;
  for (const Motion motion : {Motion::forward, Motion::backward})
    if (const double tau = torque(motion); tau * sign(motion) > 0.0) return tau / inertia;
  return 0.0;
}

/// The flight from a state over a short time [s] under the inputs that hold now, by the accelerations in the middle of
/// it.
template <class Drive>
FreeFlight free_flight(const Drive& drive, double t, const ShaftState& gear, const ShaftState& worm, double duration) {
  const auto& mesh = drive.mesh();
  const auto accelerations = [&](double time, const ShaftState& g, const ShaftState& w) {
    const Moment<double> at{time, g.angle, g.speed, mesh.i * w.speed, mesh.i * w.angle};
    const auto input = drive.inputs(at, motion_of(g.speed));
    const double on_worm = free_acceleration(w.speed, mesh.Jw * mesh.i,
                                             [&](Motion motion) { return drive.side_torques(input, at, motion).worm; });
    const double on_gear = free_acceleration(g.speed, drive.Jg(),
                                             [&](Motion motion) { return drive.side_torques(input, at, motion).gear; });
    return std::pair{ConstantAcceleration{on_gear}, ConstantAcceleration{on_worm}};
  };
  const auto [g0, w0] = accelerations(t, gear, worm);
  ShaftState g = gear, w = worm;
  g0.move(g, 0.5 * duration);
  w0.move(w, 0.5 * duration);
  const auto [g1, w1] = accelerations(t + 0.5 * duration, g, w);
  return {g1, w1, drive.effects().transmission(gear.angle).slope * gear.speed - worm.speed, duration};
}

}  // namespace wormdrive
