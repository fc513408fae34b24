#pragma once
#include "diagnosis/fitting/hypothesis.hpp"

namespace wormdrive {

/// Standard deviations that a fit found: of the sensor [rad] and of the torque of the process [N m]; of several
/// recordings the mean squares over all samples while moving.
struct NoiseSizes {
  double angle{}, torque{};
};
NoiseSizes noise_sizes(const Evaluation& evaluation, const Hypothesis& h);

}  // namespace wormdrive
