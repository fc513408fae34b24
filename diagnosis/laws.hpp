#pragma once
#include "diagnosis/hypothesis.hpp"

namespace wormdrive {

/// Fits the other laws of a finite suspect in a hypothesis, where it has several, and takes one that does better: of
/// two shapes of a fall, that which promises more from a start far away is not always the one that fits.
void try_other_laws(const Evaluation& by, Hypothesis& h, const Suspect& suspect);

}  // namespace wormdrive
