#pragma once
#include <numbers>

#include "core/numbers/sine_cosine.hpp"

namespace wormdrive {

/// What the gear should do at one time: theta_d [rad], theta_d' [rad/s], theta_d'' [rad/s^2].
struct ReferencePoint {
  double angle = 0.0;
  double speed = 0.0;
  double acceleration = 0.0;

  ReferencePoint& operator+=(const ReferencePoint& b) {
    angle += b.angle;
    speed += b.speed;
    acceleration += b.acceleration;
    return *this;
  }
};

/// A point of amplitude sin(2 pi turns), where turns grows by a frequency [Hz].
inline ReferencePoint sine_point(double amplitude, double turns, double frequency) {
  const SineAndCosine now = sine_and_cosine_of_turns(turns);
  const double omega = 2.0 * std::numbers::pi * frequency, angle = amplitude * now.sine;
  return {angle, amplitude * omega * now.cosine, -(omega * omega) * angle};
}

}  // namespace wormdrive
