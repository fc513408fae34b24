#pragma once
#include <string>
#include <vector>

#include "diagnosis/verdict/adequacy.hpp"

namespace wormdrive {

/// The strongest line in the spectrum of the residuals against its neighbours; factor: what they are demodulated by.
ScoreTest spectral_line(const Evaluation& evaluation, const Hypothesis& h, std::size_t recording,
                        const std::vector<double>* factor, std::string name);

}  // namespace wormdrive
