#pragma once
#include <optional>
#include <span>

#include "control/lanes/kind.hpp"
#include "control/lanes/trial.hpp"
#include "control/lanes/variant.hpp"
#include "control/reference_point.hpp"
#include "core/numbers/sine_cosine.hpp"
#include "events/taylor/accuracy.hpp"
#include "events/taylor/tapes/series.hpp"

namespace wormdrive {

/// A sample that all trials of a batch have in common.
struct LaneSample {
  long number;
  double t;       ///< [s]
  double period;  ///< since the sample before [s]; 0 at the first
  double step;    ///< to the next one [s]; not a number where every trial has to go on alone
  double next;    ///< when that is [s]
  bool counts;    ///< whether metrics are taken of it
  ReferencePoint desired;
};

/// The equations of trials of which no step has a closed form.
struct LaneTapes {
  const TapeCode* code = nullptr;  ///< what they have in common; nullptr: closed forms
  double* memory = nullptr;        ///< of each register, so many numbers: TapeSeriesOf, and the numbers of a mode ...
  std::size_t room = 0;            ///< ... across the switching surface
  /// The section of a table of a trial, lanes counted through, for an argument.
  SectionOf<double> (*section)(void* owner, int lane, int table, double x) = nullptr;
  /// e^x of any x, as a trial alone has it.
  double (*exp)(double x) = nullptr;
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
  bool is_late;     ///< samples see the angle of some time ago, which is less than a sample
  /// Of every sample of all registers, sample by sample: the noise of the encoders [rad] and what disturbs the shafts
  /// [N m]; null where nothing is random.
  const double *noise, *disturbance;
  LaneTapes tapes;

  void* owner;
  /// Takes a trial, lanes counted through, to the next sample under a torque [N m] and what disturbs the shaft, events
  /// included.
  void (*go_on)(void* owner, int lane, const LaneSample& sample, double torque, double disturbance);
  /// Shows what its monitor may have to note.
  void (*note)(void* owner, int lane, const ControlRecord& record);
  /// Sine and cosine of any angle, as a trial alone has them.
  SineAndCosine (*sine_and_cosine)(double angle);
};

/// Trials that take their samples side by side: those of a register, or of two where a step waits for its own results.
int lanes_of(LaneKind kind, const LaneVariant& variant);

/// Lets the trials of a batch take these samples. Every trial gets the bits that it would get alone.
void take_samples(LaneKind kind, const LaneBatch& batch, std::span<const LaneSample> samples);

}  // namespace wormdrive
