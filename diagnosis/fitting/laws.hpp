#pragma once
#include "diagnosis/fitting/hypothesis.hpp"

namespace wormdrive {

/// Fits the other laws of a finite candidate in a hypothesis, where it has several, and takes one that does better: of
/// two shapes of a fall, that which promises more from a start far away is not always the one that fits.
void try_other_laws(const Evaluation& evaluation, Hypothesis& h, const Candidate& candidate);

}  // namespace wormdrive
