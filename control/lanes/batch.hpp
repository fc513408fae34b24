#pragma once
#include <optional>
#include <span>

#include "control/lanes/kind.hpp"
#include "control/lanes/trial.hpp"
#include "control/lanes/variant.hpp"
#include "control/reference_point.hpp"
#include "core/numbers/sine_cosine.hpp"
#include "events/taylor/accuracy.hpp"

namespace wormdrive {

/// A sample that all trials of a batch have in common.
struct LaneSample {
  long number;
  double t;       ///< [s]
  double period;  ///< since the sample before [s]; 0 at the first
  double step;    ///< to the next one [s]; not a number where every trial has to go on alone
  bool counts;    ///< whether metrics are taken of it
  ReferencePoint desired;
};

/// Trials that take their samples together, a register of them after the other, and who sees to one of them alone.
struct LaneBatch {
  static constexpr int most = 16;  ///< trials: two registers of the widest kind

  double* trials;  ///< LaneTrial of each register
  int registers;
  const unsigned* alive;  ///< a bit for every lane of a register that holds a trial which goes on
  TaylorAccuracy accuracy;
  bool estimate_is_aligned;  ///< every load is estimated at the angle of the gear: no offset, and exact encoders
  LaneVariant variant;
  bool is_delayed;  ///< a torque is applied a sample after it was decided
  bool is_rough;    ///< an encoder counts, is noisy, or its zero is off
  /// Of every sample of all registers, sample by sample: the noise of the encoders [rad] and what disturbs the shafts
  /// [N m]; null where nothing is random.
  const double *noise, *disturbance;

  void* owner;
  /// Takes a trial, lanes counted through, to the next sample under a torque [N m] and what disturbs the shaft, events
  /// included.
  void (*go_on)(void* owner, int lane, const LaneSample& sample, double torque, double disturbance);
  /// Shows what its monitor may have to note.
  void (*note)(void* owner, int lane, const ControlRecord& record);
  /// Sine and cosine of any angle, as a trial alone has them.
  SineAndCosine (*sine_and_cosine)(double angle);
};

/// Lets the trials of a batch take these samples. Every trial gets the bits that it would get alone.
void take_samples(LaneKind kind, const LaneBatch& batch, std::span<const LaneSample> samples);

}  // namespace wormdrive
