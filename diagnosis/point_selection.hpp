#pragma once
#include <string>
#include <vector>

#include "diagnosis/point_candidates.hpp"

namespace wormdrive {

/// Thresholds of a selection over torque points.
struct PointThresholds {
  double delta_bic = 6.0;      ///< evidence for an effect
  double held_out_gain = 3.0;  ///< [nats] on points that the fit did not see, both ways together
  double tolerances = 3.5;     ///< how far outside its tolerance a stated parameter has to lie
  double alike = 4.6;          ///< difference of BIC up to which two models are equally good: odds of ten to one
  double imitated = 0.95;      ///< share of an effect's signature above which the other named ones can imitate it
  std::size_t causes = 6;      ///< at most
  std::size_t together = 2;    ///< effects that are looked for at once; further ones are added one by one
  std::size_t unstated = 5;    ///< the same among those that concern no stated parameter
  std::size_t models = 10;     ///< that are followed at each number of effects
};

/// A model with its fits.
struct FittedModel {
  PointModel model;
  PointFit all;
  double bic = 0.0;
  double doubt = 0.0;     ///< what it costs that stated parameters lie far outside their tolerance, in units of BIC
  double held_out = 0.0;  ///< negative log likelihood of both halves, each by the fit of the other [nats]

  double rank() const { return bic + doubt; }
};

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
/// std::invalid_argument if the scenario has no torque at the points.
PointSelection select(const PointFitter& fitter, const std::vector<PointCandidate>& candidates,
                      const PointThresholds& thresholds);

}  // namespace wormdrive
