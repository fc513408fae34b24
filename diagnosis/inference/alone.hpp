#pragma once
#include <vector>

#include "diagnosis/inference/selection.hpp"

namespace wormdrive {

/// Tries what is sought by itself only: it takes the place of all causes that were found if it explains the data better
/// than these do together.
void try_alone(const Evaluation& evaluation, const std::vector<Candidate>& all, Selection& found);

}  // namespace wormdrive
