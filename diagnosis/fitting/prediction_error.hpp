#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/fitting/hypothesis.hpp"

namespace wormdrive {

/// Error of predicting the gear angle that far ahead from samples that were held out, rms [rad].
double error_ahead(const Evaluation& evaluation, const Hypothesis& h, double horizon);

/// Share of that error that goes once a torque is added to the command at every sample [N m]: 0 where blocks differ as
/// much by chance (95 %), infinity where no two blocks can be predicted.
double share_of_error(const Evaluation& evaluation, const Hypothesis& h, double horizon, std::span<const double> extra);
/// The same once another hypothesis takes the place of one, by the ratios of its blocks: errors of blocks whose motions
/// differ may be of any size.
double share_of_error(const Evaluation& evaluation, const Hypothesis& h, const Hypothesis& other, double horizon);

/// Errors of predicting the gear angle ahead from samples that were held out, by the model before and after, at every
/// horizon. The seed is that of the bootstrap over blocks.
std::vector<PredictionError> prediction_errors(const Evaluation& evaluation, const Hypothesis& before,
                                               const Hypothesis& after, std::uint64_t seed);

/// A few held-out stretches with both predictions, of every horizon the ones with the largest, the median and the
/// smallest error before.
std::vector<PredictionExample> prediction_examples(const Evaluation& evaluation, const Hypothesis& before,
                                                   const Hypothesis& after);

}  // namespace wormdrive
