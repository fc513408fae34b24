#pragma once
#include <vector>

#include "diagnosis/coordinates.hpp"
#include "diagnosis/diagnosis_settings.hpp"
#include "diagnosis/magnitudes.hpp"
#include "scenarios/scenario.hpp"

namespace wormdrive {

/// The stated numbers that stay free in every fit, each with its tolerance: those of the settings, else those of the
/// scenario, else 1 % of mesh friction, load, inertias and torque gain, 1 % of the rms torque of torque offset, and
/// 0.01 rad of the load's angle. Throws std::invalid_argument for a tolerance of a field that the catalogue does not
/// have.
std::vector<Coordinate> toleranced_coordinates(const Scenario& scenario, const Magnitudes& sizes,
                                               const std::vector<Tolerance>& stated);

}  // namespace wormdrive
