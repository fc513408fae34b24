#pragma once
#include "control/lemma1_monitor.hpp"
#include "control/metrics.hpp"
#include "control/pid.hpp"
#include "control/sliding.hpp"
#include "control/speed_estimator.hpp"
#include "events/taylor/nominal/driven.hpp"

namespace wormdrive {

/// A mode under a held torque, of one trial or of several at once; motion 0 where there is none.
template <class V>
struct LaneModeOf {
  DrivenMotionOf<V> drive;
  V pull, bend;  ///< of friction that falls with the speed, see FallOf
};
using LaneMode = LaneModeOf<double>;

/// All that a sample of a closed loop changes or needs, of one trial or of several at once: encoder, controller, motor
/// and modes. It consists of V alone.
template <class V>
struct LaneTrial {
  SlidingLawOf<V> sliding;
  PidLawOf<V> pid;
  V load_torque, load_angle_offset, load_constant;  ///< of the estimated load
  V encoder_share, encoder_zero;  ///< what the encoder shows too much: a share of the angle, and an angle [rad]
  V count;                        ///< the angle of an encoder's count; infinite without counts [rad]
  V zero_error;                   ///< of an encoder, which the speed does not show [rad]
  V age, latched;                 ///< of the angle that the next sample sees [s], and that angle [rad]
  SpeedEstimatorOf<V> speed;
  SampleSums<V> sums;
  Lemma1Quiet<V> quiet;
  V limit;                                 ///< of the motor's torque [N m]
  V left;                                  ///< of the torque decided at the sample before, by the limit [N m]
  V torque;                                ///< that the motor gives, where it does not answer at once [N m] ...
  V behind;                                ///< ... but after this delay or with this time constant [s]
  LaneModeOf<V> mode, across;              ///< the present mode, and the one across the switching surface
  V flank_changes, counted_flank_changes;  ///< that the lane has seen, and those that metrics count
  SineAndCosineOf<V> arm_offset;           ///< of the arm against the gear
  V per_speed;                             ///< of friction that falls with the speed, see FallOf
  V theta, omega;                          ///< of the gear [rad, rad/s]

  /// counts: whether metrics are taken of the sample.
  [[gnu::always_inline]] void count_flank_changes(const MaskOf<V>& which, bool counts) {
    flank_changes = select(which, flank_changes + 1.0, flank_changes);
    if (counts) counted_flank_changes = select(which, counted_flank_changes + 1.0, counted_flank_changes);
  }
};

inline constexpr std::size_t lane_fields = sizeof(LaneTrial<double>) / sizeof(double);

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
