#pragma once
#include <vector>

#include "diagnosis/data/recording.hpp"
#include "diagnosis/diagnosis.hpp"
#include "diagnosis/diagnosis_settings.hpp"

namespace wormdrive {

/// Finds out what a scenario lacks to predict recordings of its drive, names it where the data allow, and extends the
/// scenario by it. Several recordings are of one drive; each has an initial state of its own. Throws
/// std::invalid_argument for recordings that are too short, and for tolerances of fields that do not exist.
Diagnosis diagnose(const Scenario& scenario, const std::vector<Recording>& recordings,
                   const DiagnosisSettings& settings = {});

}  // namespace wormdrive
