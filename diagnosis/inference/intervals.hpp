#pragma once
#include <string_view>

#include <Eigen/Core>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/fitting/hypothesis.hpp"

namespace wormdrive {

/// Covariance of the free coordinates in SI by a sandwich: the curvature of the likelihood, and the scatter of its
/// slopes over blocks of time, which need not be as independent as the likelihood takes them [Huber 1967], each block
/// judged without its own share in the fit [Bell and McCaffrey 2002]; nowhere less than the likelihood alone says. Of
/// an evaluated hypothesis. rounds: how often the slopes are taken again, over as much as the errors that came out: an
/// event that passes a sample makes the likelihood steep over less.
Eigen::MatrixXd covariance(const Evaluation& evaluation, const Hypothesis& h, int rounds);

/// What the predictor itself gets wrong, beyond the noise, for one by teeth that yield a little: standard error of a
/// free coordinate in SI.
double structural_error(const Hypothesis& h, std::size_t coordinate);

/// A number with its standard error and 95 % interval.
Estimate estimate(std::string_view field, const Unit& unit, double value, double error);

/// The parameters of a candidate in a hypothesis with standard errors and 95 % intervals.
EstimatedEffect estimated(const Hypothesis& h, const Eigen::MatrixXd& covariance, std::string_view effect,
                          const std::vector<Coordinate>& coordinates);

/// All free coordinates of a hypothesis together, as fields of effects.
JointEstimate joint_estimate(const Hypothesis& h, const Eigen::MatrixXd& covariance);

}  // namespace wormdrive
