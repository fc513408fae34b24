#pragma once

namespace wormdrive {

/// What all trials of a batch have in common, so that a kernel need not ask for it at every sample.
struct LaneVariant {
  bool ideal = true;   ///< the sensor is exact, and the motor gives at once the torque that it is told
  bool pid = false;    ///< the law is the PID; else the sliding one
  bool swings = true;  ///< an arm under gravity loads the gear; else a constant torque
  bool rubs = false;   ///< bearings are viscous

  bool operator==(const LaneVariant&) const = default;
};

}  // namespace wormdrive
