#pragma once

namespace wormdrive {

/// The time of a drive that others step. Steps of one length are counted, not added up, so that the k-th ends where its
/// number says; a step of another length begins a new count.
struct StepClock {
  double base = 0.0;    ///< where the count began [s]
  double length = 0.0;  ///< of the steps that are counted [s]
  double count = 0.0;

  double now() const { return base + count * length; }
  /// The clock after a step [s].
  StepClock after(double step) const {
    return step == length ? StepClock{base, length, count + 1.0} : StepClock{now(), step, 1.0};
  }
};

}  // namespace wormdrive
