#pragma once

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

}  // namespace wormdrive
