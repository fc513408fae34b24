#pragma once
#include <cstddef>

#include "control/lanes/kind.hpp"
#include "core/numbers/sine_cosine.hpp"
#include "events/taylor/accuracy.hpp"
#include "events/taylor/nominal/driven.hpp"

namespace wormdrive {

/// What a step under a held torque needs of a drive, or of the drives of one register. It consists of V alone.
template <class V>
struct LaneDrive {
  DrivenMotionOf<V> driven;       ///< the present mode; motion 0 at rest
  SineAndCosineOf<V> arm_offset;  ///< of the arm against the gear
};
inline constexpr std::size_t lane_drive_fields = sizeof(LaneDrive<double>) / sizeof(double);

/// Drives that others step, a register of them after the other, and who sees to one of them alone. Angles, speeds and
/// torques of all drives stand in the order of the drives, filled up to whole registers.
struct StepBatch {
  double *theta, *omega;  ///< [rad, rad/s]
  const double* torque;   ///< held during the step [N m]
  const double* drives;   ///< LaneDrive of each register
  int registers;
  const unsigned* alive;  ///< a bit for every lane of a register that holds a drive which goes on
  double step;            ///< [s]; not a number where every drive has to go on alone
  TaylorAccuracy accuracy;

  void* owner;
  /// Takes a drive, counted through, through its step under a torque [N m], events included.
  void (*go_on)(void* owner, int drive, double torque);
  /// Sine and cosine of any angle, as a drive alone has them.
  SineAndCosine (*sine_and_cosine)(double angle);
};

/// Lets the drives of a batch make a step. Every one gets the bits that it would get alone.
void take_step(LaneKind kind, const StepBatch& batch);

/// Puts a drive into its lane among others.
inline void write_lane(double* drives, int lanes, int drive, const LaneDrive<double>& fields) {
  put_into_lane(fields, drives + static_cast<std::size_t>(drive / lanes * lanes) * lane_drive_fields + drive % lanes,
                static_cast<std::size_t>(lanes));
}

}  // namespace wormdrive
