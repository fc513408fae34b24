#pragma once
#include <vector>

#include "description/scenario.hpp"
#include "diagnosis/data/prepared_recording.hpp"

namespace wormdrive {

/// How far a motion may go, in SI.
struct MotionLimits {
  double torque;     ///< of the motor, either way [N m]
  double speed;      ///< of the gear, either way [rad/s]
  double low, high;  ///< of the gear's angle [rad]

  double half() const { return 0.5 * (high - low); }
};

/// What a scenario and its recordings leave to an experiment: what is stated; else the way between stops, as far as
/// the load pulls either way or the recordings went, and multiples of the torque and speed that they reached.
MotionLimits allowed_range(const Scenario& scenario, const std::vector<PreparedRecording>& recordings, bool load_turns);

/// A motion of four numbers: a slow sweep through the middle of a range, and seven fast sines on top. Steps would let
/// the teeth bounce, which tells more of the teeth than of anything else.
struct ProbingMotion {
  double amplitude;       ///< of the sweep [rad]
  double frequency;       ///< of the sweep [Hz]
  double fast_amplitude;  ///< of each sine [rad]
  double fastest;         ///< frequency of the last one [Hz]
};

/// A closed loop that follows a motion, with all its poles at one distance from the origin.
ControlScenario following(const Scenario& scenario, const ProbingMotion& motion, const MotionLimits& range,
                          double period);

/// The highest frequency that such a loop follows when it samples once per period [Hz].
double highest_frequency(double period);

/// How far a recording of such a motion went: largest torque and speed, lowest and highest angle.
MotionLimits reached(const Recording& recording, const Reference& reference);

}  // namespace wormdrive
