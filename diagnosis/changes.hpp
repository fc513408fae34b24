#pragma once
#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/diagnosis_settings.hpp"

namespace wormdrive {

/// The scenario with everything that was fitted to its data, within tolerances or beyond; faults of the recording are
/// left out.
Scenario as_fitted(const Scenario& stated, const Diagnosis& fitted);

/// How well a diagnosis has come to know the numbers of the drive.
std::vector<Tolerance> known_tolerances(const Diagnosis& fitted);

/// What changed between a diagnosis and that of later data, whose scenario was as_fitted() to the earlier ones. The
/// sentence of the later one becomes what changed, and by how much.
void tell_changes(const Diagnosis& earlier, const Scenario& fitted, Diagnosis& later);

}  // namespace wormdrive
