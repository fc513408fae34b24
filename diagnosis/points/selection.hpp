#pragma once
#include <string>
#include <vector>

#include "diagnosis/points/comparison.hpp"

namespace wormdrive {

/// What became of a candidate.
struct PointJudgement {
  std::size_t candidate;                        ///< index
  FittedModel with;                             ///< the model that has it
  double delta_bic = 0.0, held_out_gain = 0.0;  ///< that model against the same without it
  bool named = false;
  std::string outcome;  ///< "named", or why not
};

/// What a selection comes to.
struct PointSelection {
  FittedModel before, after;
  std::vector<PointJudgement> judgements;         ///< of every candidate, named ones first, then by evidence
  std::vector<std::vector<std::size_t>> classes;  ///< candidates that can stand for each other, named ones first
};

/// Follows the best models of one effect, of two, and so on, takes the largest whose every step passes the thresholds,
/// drops what others made superfluous, and looks for the effects that could stand in the place of a named one. Throws
/// std::invalid_argument if the scenario has no torque at the points. The result does not depend on the number of
/// threads.
PointSelection select(const PointFitter& fitter, const std::vector<PointCandidate>& candidates, int threads);

}  // namespace wormdrive
