#pragma once
#include <vector>

#include "description/scenario.hpp"
#include "diagnosis/candidates/coordinates.hpp"
#include "diagnosis/candidates/magnitudes.hpp"
#include "diagnosis/diagnosis_settings.hpp"

namespace wormdrive {

/// The stated parameters, each with its tolerance: that of the settings, else of the scenario. Those with a tolerance
/// above 0 stay free in every fit; one that is exactly known is a candidate like any other effect. Throws
/// std::invalid_argument for a tolerance of a field that the catalogue does not have.
std::vector<Coordinate> toleranced_coordinates(const Scenario& scenario, const Magnitudes& sizes,
                                               const std::vector<Tolerance>& stated);

}  // namespace wormdrive
