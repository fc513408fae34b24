#pragma once
#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/linear_system.hpp"
#include "diagnosis/magnitudes.hpp"

namespace wormdrive {

/// What recordings can show of every suspect, from the signatures that it would leave in their innovations: the
/// smallest size that can be seen beside the stated tolerances, and the smallest that can be told from every other
/// suspect. An effect for which two sizes stand, as the lag's, has its middle start told.
std::vector<Visibility> certificate(const LinearSystem& linear, const Hypothesis& base, const std::vector<Suspect>& all,
                                    const Magnitudes& sizes);

}  // namespace wormdrive
