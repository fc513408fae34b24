#pragma once
#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/inference/selection.hpp"

namespace wormdrive {

/// All candidates of a search, what is named first and then those with more evidence, each with what came of it.
std::vector<RankedCandidate> ranking(const Evaluation& evaluation, const Selection& selection,
                                     const std::vector<Candidate>& all);

}  // namespace wormdrive
