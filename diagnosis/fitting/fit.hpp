#pragma once
#include <Eigen/Core>

#include "diagnosis/fitting/hypothesis.hpp"
#include "diagnosis/fitting/normal_equations.hpp"
#include "diagnosis/rules/evidence.hpp"

namespace wormdrive {

/// Step of a free coordinate for its derivative, in scales.
inline constexpr double derivative_step = 0.02;

/// Fits the free coordinates by Levenberg and Marquardt on Student's t, whose scales and whitening are estimated anew
/// at every trial. Stops after so many rounds, or when one gains less than so many nats.
void fit(const Evaluation& evaluation, Hypothesis& h, int rounds, double least_gain = rules::least_round_gain);

/// Doubles or halves the two kinds of process noise, up to `depth` times, as long as that gains.
void adjust_noise(const Evaluation& evaluation, Hypothesis& h, int depth);

/// Whether one makes the data more likely. Whitening and torques that last explain the same; where data hardly tell,
/// better is the one that leaves what is slow to the drive.
bool explains_better(const Hypothesis& h, const Hypothesis& other);

/// Tries different mixtures of process noise.
void restart_noise(const Evaluation& evaluation, Hypothesis& h);

/// The same with the least process noise that the data demand. Where it is hardly told from rounding, or overstated for
/// what predictions show, it is the least by which predictions get no worse.
Hypothesis with_least_noise(const Evaluation& evaluation, Hypothesis h, bool is_overstated);

/// Precision of the tolerances in scales, on the diagonal, and their pull on the right-hand side.
void add_tolerances(const Hypothesis& h, Eigen::MatrixXd& A, Eigen::VectorXd& b);

}  // namespace wormdrive
