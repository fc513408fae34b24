#pragma once
#include "diagnosis/hypothesis.hpp"

namespace wormdrive {

/// Fits a gap between the teeth together with how they bounce, by trying sizes around what is there: teeth that
/// bounce leave a likelihood with many maxima. widest: of the steps, 1 for a gap that was never fitted so. Nothing
/// where a hypothesis has no free gap.
void fit_bounces(const Evaluation& by, Hypothesis& h, double widest);

/// Gives a scenario with backlash or compliance teeth that can be simulated, where it does not state them in full: as
/// stiff as an impact is short, and damped by as much as the restitution asks for.
void give_teeth_to_bounce(Scenario& scenario, const Bounce& bounce);

}  // namespace wormdrive
