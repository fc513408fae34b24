#pragma once
#include "diagnosis/diagnosis.hpp"
#include "diagnosis/points/selection.hpp"

namespace wormdrive {

/// Ratio of a scenario's gear, 1 without one.
double stated_ratio(const Scenario& scenario);

/// What torque points can show of every effect of the catalogue: the smallest size that would be seen beside what is
/// named and the stated tolerances, and the smallest that could be told from the nearest other effect.
std::vector<Visibility> point_certificate(const PointFitter& fitter, const std::vector<PointCandidate>& candidates,
                                          const FittedModel& model);

/// Structure left over the speed, or over the load at break-in: neighbours that err to the same side.
std::vector<Remainder> point_remainders(const TorquePoints& points, const std::vector<double>& errors);

/// Decides what a diagnosis of torque points may claim; fills verdict, classes and sentence, and withdraws names
/// that leave structure behind without a clear gain.
void judge_points(Diagnosis& diagnosis, const PointSelection& selection, const std::vector<PointCandidate>& candidates);

/// The same points at another load as the experiment that splits the class, if they do.
void propose_other_load(Diagnosis& diagnosis, const Scenario& scenario, const TorquePoints& more,
                        const std::vector<PointCandidate>& candidates, const PointSelection& selection);

}  // namespace wormdrive
