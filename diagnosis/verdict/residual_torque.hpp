#pragma once
#include "diagnosis/diagnosis.hpp"
#include "diagnosis/fitting/hypothesis.hpp"

namespace wormdrive {

/// The torque on the worm that would explain what a model leaves, as means over 25 ms in which the drive moves
/// throughout, of the model before and after; what the observer has taken up counts as left.
ResidualTorque residual_torque(const Evaluation& evaluation, const Hypothesis& before, const Hypothesis& after);

}  // namespace wormdrive
