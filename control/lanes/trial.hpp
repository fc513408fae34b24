#pragma once
#include <cstring>

#include "control/lemma1_monitor.hpp"
#include "control/metrics.hpp"
#include "control/pid.hpp"
#include "control/sliding.hpp"
#include "control/speed_estimator.hpp"
#include "events/taylor/nominal/driven.hpp"

namespace wormdrive {

/// All that a sample of a closed loop changes or needs, of one trial or of several at once: encoder, controller, motor
/// and a mode under a held torque. It consists of V alone.
template <class V>
struct LaneTrial {
  SlidingLawOf<V> sliding;
  PidLawOf<V> pid;
  V load_torque, load_angle_offset, load_constant;  ///< of the estimated load
  V encoder_share, encoder_zero;  ///< what the encoder shows too much: a share of the angle, and an angle [rad]
  V count;                        ///< the angle of an encoder's count; infinite without counts [rad]
  V zero_error;                   ///< of an encoder, which the speed does not show [rad]
  SpeedEstimatorOf<V> speed;
  SampleSums<V> sums;
  Lemma1Quiet<V> quiet;
  V limit;                                 ///< of the motor's torque [N m]
  V left;                                  ///< of the torque decided at the sample before, by the limit [N m]
  V torque;                                ///< that the motor gives, where it does not answer at once [N m] ...
  V behind;                                ///< ... but after this delay or with this time constant [s]
  DrivenMotionOf<V> drive;                 ///< the present mode; motion 0 at rest
  SineAndCosineOf<V> arm_offset;           ///< of the arm against the gear
  V pull, bend, per_speed, speed_of_fall;  ///< of friction that falls with the speed in that mode, see FallOf
  V theta, omega;                          ///< of the gear [rad, rad/s]
};

inline constexpr std::size_t lane_fields = sizeof(LaneTrial<double>) / sizeof(double);

/// A struct of doubles out of its lane among others, as put_into_lane() has put it there. first: its own.
template <class Fields>
Fields from_lane(const double* first, std::size_t lanes) {
  double list[sizeof(Fields) / sizeof(double)];
  for (std::size_t k = 0; k < sizeof list / sizeof(double); ++k) list[k] = first[k * lanes];
  Fields fields;
  std::memcpy(&fields, list, sizeof fields);
  return fields;
}

/// A trial in its lane among others.
class Lane {
 public:
  /// memory: of the register's LaneTrial; lanes: in a register.
  Lane(double* memory, int lanes, int lane) : first_(memory + lane), lanes_(lanes) {}

  LaneTrial<double> read() const { return from_lane<LaneTrial<double>>(first_, lanes_); }
  void write(const LaneTrial<double>& trial) const { put_into_lane(trial, first_, lanes_); }

 private:
  double* first_;
  std::size_t lanes_;
};

}  // namespace wormdrive
