#pragma once

namespace wormdrive {

/// In the place of a controller: commands a torque at one sample, and leaves the run at the next one.
struct HeldTorque {
  double torque = 0.0, disturbance = 0.0;
  double latched = 0.0;  ///< the angle that the next sample sees, where it is late [rad]
  bool held = false;

  template <class Drive>
  void latch(const Drive&, const typename Drive::Instant& now) {
    latched = now.x[0];
  }
  bool pause() const { return held; }
  template <class Drive>
  double sample(Drive& drive, const typename Drive::Instant&) {
    held = true;
    drive.disturb(disturbance);
    return torque;
  }
};

}  // namespace wormdrive
