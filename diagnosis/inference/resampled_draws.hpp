#pragma once
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/fitting/hypothesis.hpp"

namespace wormdrive {

/// Draws of the numbers of a joint estimate from what the data leave open, without taking it for normal: a weighted
/// likelihood bootstrap [Newton and Raftery 1994]. Each draw is a fit to the same data, in which blocks of time have
/// exponential weights and tolerances lie about random centres, with the noise of the given fit. What
/// covariance() has beyond the scatter of blocks is added, and the predictor's own errors. Of an evaluated fit,
/// with its covariance(); the draws depend on the seed and on nothing else.
std::vector<std::vector<double>> resampled_draws(const Evaluation& evaluation, const Hypothesis& fit,
                                                 const Eigen::MatrixXd& covariance, const JointEstimate& of, int draws,
                                                 std::uint64_t seed);

}  // namespace wormdrive
