#pragma once
#include <vector>

#include "diagnosis/diagnosis_settings.hpp"
#include "diagnosis/inference/selection.hpp"

namespace wormdrive {

/// Searches for causes. A noise model that takes much of what is slow for its own hides slow effects as well, friction
/// among them; then a search without one is made, and kept if it predicts clearly better. Where more noise than torque
/// is at work, whatever was found, pairs of causes would not follow the motion either. torque: of the motor, rms [N m].
Selection searched_causes(const Evaluation& evaluation, const std::vector<Candidate>& all, const Hypothesis& base,
                          double torque, const DiagnosisSettings& settings);

}  // namespace wormdrive
