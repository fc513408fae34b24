#pragma once
#include <vector>

#include "diagnosis/candidates/catalogue.hpp"
#include "diagnosis/candidates/magnitudes.hpp"
#include "diagnosis/data/prepared_recording.hpp"
#include "diagnosis/diagnosis.hpp"
#include "diagnosis/diagnosis_settings.hpp"

namespace wormdrive {

/// Looks for what would settle a diagnosis that is ambiguous or unexplained: a motion that tells the members of the
/// first class apart for which there is one, or the candidates that do best though none is believed; else an advice
/// that is no motion.
void propose_next_step(Diagnosis& d, const Scenario& scenario, const std::vector<Candidate>& all,
                       const std::vector<Coordinate>& toleranced, const Magnitudes& sizes,
                       const std::vector<PreparedRecording>& recordings, const DiagnosisSettings& settings);

}  // namespace wormdrive
