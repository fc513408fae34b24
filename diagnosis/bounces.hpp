#pragma once
#include "diagnosis/hypothesis.hpp"

namespace wormdrive {

/// Fits a gap between the teeth together with their restitution, by trying sizes around what is there: teeth that
/// bounce leave a likelihood with many maxima. Nothing where a hypothesis has no free gap.
void fit_bounces(const Evaluation& by, Hypothesis& h);

/// Gives a scenario with backlash teeth that can be simulated, where it states none: stiff, and damped by as much as the
/// restitution asks for.
void give_teeth_to_bounce(Scenario& scenario, double restitution);

}  // namespace wormdrive
