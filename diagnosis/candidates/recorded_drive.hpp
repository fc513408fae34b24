#pragma once
#include <utility>

#include "core/effects.hpp"
#include "diagnosis/faults/recording_faults.hpp"

namespace wormdrive {

/// All that stands between a scenario and a recording: the effects of the drive, and the faults of the recording.
struct RecordedDrive {
  Effects<double> effects{};
  RecordingFaults faults{};

  RecordedDrive() = default;
  /// In a recording without a fault.
  RecordedDrive(Effects<double> of_drive) : effects(std::move(of_drive)) {}

  /// Calls visit(optional) for every effect, then for every fault.
  template <class Visit>
  void for_each(Visit&& visit) {
    effects.for_each(visit);
    faults.for_each(visit);
  }
  template <class Visit>
  void for_each(Visit&& visit) const {
    effects.for_each(visit);
    faults.for_each(visit);
  }
};

}  // namespace wormdrive
