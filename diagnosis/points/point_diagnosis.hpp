#pragma once
#include "diagnosis/diagnosis.hpp"
#include "diagnosis/diagnosis_settings.hpp"
#include "diagnosis/points/selection.hpp"
#include "diagnosis/points/torque_points.hpp"

namespace wormdrive {

/// Finds out what a scenario lacks to predict measured torques, names it where they allow, and extends the scenario by
/// it. more: the same points at another load, for the experiment that splits a class; its torques are not looked at.
Diagnosis diagnose(const Scenario& scenario, const TorquePoints& points, const std::optional<TorquePoints>& more,
                   const DiagnosisSettings& settings = {});

}  // namespace wormdrive
