#pragma once
#include <string>
#include <vector>

#include "description/scenario.hpp"
#include "diagnosis/predictor/restitution.hpp"

namespace wormdrive {

/// A scenario with the effects that a diagnosis has found, as a run takes it: what a fit moves within a recording may
/// lack what a simulation needs, or stand beside what it cannot be combined with. Adds to the remarks what it changes.
Scenario extended_scenario(Scenario stated, const Effects<double>& found, const Restitution& impact,
                           std::vector<std::string>& remarks);

}  // namespace wormdrive
