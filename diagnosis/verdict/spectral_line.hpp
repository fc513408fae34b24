#pragma once
#include <string>
#include <vector>

#include "diagnosis/verdict/adequacy.hpp"

namespace wormdrive {

/// The same model with a filter that follows the angle more slowly than the lowest line, and no whitening: both take a
/// strong line for noise. To be evaluated.
Hypothesis followed_slowly(const Evaluation& evaluation, Hypothesis h);

/// The strongest line of every recording, of the model as it is or as it follows slowly.
std::vector<ScoreTest> spectral_lines(const Evaluation& evaluation, const Hypothesis& h);

/// The strongest line in the spectrum of the residuals against its neighbours; factor: what they are demodulated by.
ScoreTest spectral_line(const Evaluation& evaluation, const Hypothesis& h, std::size_t recording,
                        const std::vector<double>* factor, std::string name);

}  // namespace wormdrive
