#pragma once
#include "core/sine_cosine.hpp"

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

/// A point of amplitude sin(phase) whose phase [rad] turns at omega [rad/s].
inline ReferencePoint sine_point(double amplitude, double phase, double omega) {
  const SineAndCosine now = sine_and_cosine(phase);
  return {amplitude * now.sine, amplitude * omega * now.cosine, -amplitude * omega * omega * now.sine};
}

}  // namespace wormdrive
