#pragma once
#include <optional>

#include "diagnosis/fitting/hypothesis.hpp"

namespace wormdrive {

/// Index of a free gap between the teeth among the free coordinates; nothing where there is none.
std::optional<std::size_t> gap_of(const Hypothesis& h);

/// Finds a gap between the teeth together with how they bounce, by trying many sizes around what is there: teeth that
/// bounce leave a likelihood with many maxima. Nothing where a hypothesis has no free gap.
void find_gap(const Evaluation& evaluation, Hypothesis& h);

/// The same from what was found so, in smaller steps.
void refine_gap(const Evaluation& evaluation, Hypothesis& h);

/// Gives a scenario with backlash or compliance teeth that can be simulated, where it does not state them in full: as
/// stiff as an impact is short, and damped by as much as the restitution asks for.
void give_teeth_for_impacts(Scenario& scenario, const Restitution& impact);

}  // namespace wormdrive
