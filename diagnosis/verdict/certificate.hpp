#pragma once
#include <string>
#include <vector>

#include "diagnosis/candidates/magnitudes.hpp"
#include "diagnosis/diagnosis.hpp"
#include "diagnosis/fitting/linear_system.hpp"

namespace wormdrive {

/// What recordings can show of every candidate, from the signatures that it would leave in their innovations: the
/// smallest size that can be seen beside the stated tolerances, and the smallest that can be told from every other
/// candidate. An effect for which several sizes stand, as the lag's, has its middle start told; a periodic one every
/// number of periods that is tried.
std::vector<Visibility> certificate(const LinearSystem& linear, const Hypothesis& base,
                                    const std::vector<Candidate>& all, const Magnitudes& sizes);

/// Effects that the data cannot show, whatever is chosen for them.
std::vector<std::string> unobservable(const std::vector<Visibility>& certificate);

}  // namespace wormdrive
