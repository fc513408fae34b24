#pragma once
#include <vector>

#include <Eigen/Core>

#include "diagnosis/fitting/hypothesis.hpp"

namespace wormdrive {

/// Changes of the whitened innovations, a row each, by the free coordinates, per scale; of hours of samples, so not in
/// doubles.
using Slopes = Eigen::MatrixXf;

/// Slopes as the mean of a step up and one down. steps: of each coordinate, in scales.
Slopes central_sensitivities(const Evaluation& evaluation, const Hypothesis& h, const std::vector<double>& steps);
/// Steps as long as standard errors, within limits; variances in squared scales.
std::vector<double> steps_over_errors(const Eigen::VectorXd& variances);

/// What a fit's likelihood and the scatter of its slopes over blocks of time say, in scales of the free coordinates.
struct Sandwich {
  Eigen::MatrixXd spread;   ///< covariance of the coordinates
  Eigen::MatrixXd missing;  ///< what of it random weights of the blocks do not make
};

/// Of an evaluated hypothesis. J: its central_sensitivities().
Sandwich sandwich(const Evaluation& evaluation, const Hypothesis& h, const Slopes& J);

}  // namespace wormdrive
