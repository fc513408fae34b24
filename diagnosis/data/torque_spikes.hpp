#pragma once
#include <cstddef>
#include <vector>

#include "diagnosis/data/recording.hpp"

namespace wormdrive {

/// A torque that stands far out of its neighbours, with what these suggest in its place.
struct TorqueSpike {
  std::size_t sample;
  double instead;  ///< [N m]
};

/// The spikes of a recording's torque, three samples long at most. A controller may have commanded them: only the
/// motion tells. None where they are more than a hundredth of all samples, for then they are how this torque is.
std::vector<TorqueSpike> torque_spikes(const Recording& recording);

}  // namespace wormdrive
