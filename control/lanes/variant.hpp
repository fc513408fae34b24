#pragma once

namespace wormdrive {

/// When a motor gives the torque that it is told.
enum class MotorResponse { at_once, after_delay, with_lag };

/// What all trials of a batch have in common, so that a kernel need not ask for it at every sample.
struct LaneVariant {
  bool ideal = true;   ///< the sensor is exact, and the motor gives at once the torque that it is told
  bool pid = false;    ///< the law is the PID; else the sliding one
  bool swings = true;  ///< an arm under gravity loads the gear; else a constant torque
  bool rubs = false;   ///< bearings are viscous
  int falls = 0;       ///< friction falls with the speed, with this exponent; 0: it does not
  bool falls_with_tail = false;
  bool taped = false;  ///< the equations are on tapes, whatever they are; else steps have a closed form
  MotorResponse response = MotorResponse::at_once;

  bool operator==(const LaneVariant&) const = default;
};

}  // namespace wormdrive
