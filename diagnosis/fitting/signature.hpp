#pragma once
#include <vector>

namespace wormdrive {

/// Share of a signature, 0 to 1, that lies in the span of others; 0 for one that is zero. Signatures are what the data
/// would change by, per size of an effect, in units of the noise.
double imitation(const std::vector<double>& signature, const std::vector<std::vector<double>>& others);

/// Square of what is left of a signature that others can imitate, each within its tolerance. tolerances: 0 for one that
/// is free, in units of the sizes.
double distinct(const std::vector<double>& signature, const std::vector<std::vector<double>>& others,
                const std::vector<double>& tolerances);

}  // namespace wormdrive
