#pragma once
#include <optional>
#include <string>
#include <vector>

#include "description/scenario.hpp"
#include "diagnosis/candidates/catalogue.hpp"
#include "diagnosis/candidates/magnitudes.hpp"
#include "diagnosis/experiment/motion.hpp"

namespace wormdrive {

/// What a run of a scenario with a controller writes down. Throws SimulationFailure.
Recording simulated(const Scenario& scenario);

/// What an experiment is to tell apart, and how well the bench measures.
struct Question {
  Scenario stated;  ///< the drive as its scenario has it
  Scenario found;   ///< the same with what was found
  std::vector<Candidate> contenders;
  double size;  ///< of the first contender, as it was found
  std::vector<Coordinate> toleranced;
  Magnitudes sizes;
  double noise_torque;  ///< [N m]
  double counts;        ///< of the gear's encoder per turn, 0: finer than its noise
};

/// A scenario that would tell contenders apart, and why.
struct Experiment {
  std::optional<Scenario> scenario;  ///< nothing: no motion within the range would
  std::string reason;                ///< a sentence
};

/// Seeks the motion within a range whose simulated recording tells the first contender from all others best, by the
/// certificate of its innovations, the gentlest first, with the payload as it is and doubled. One is good enough by
/// which the first contender could be told at a fraction of its size.
Experiment best_experiment(const Question& question, const MotionLimits& range, int threads);

}  // namespace wormdrive
