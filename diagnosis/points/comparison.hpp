#pragma once
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/points/candidates.hpp"

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

/// Fits models and compares them: what selection and classes have in common.
class PointComparison {
 public:
  PointComparison(const PointFitter& fitter, const std::vector<PointCandidate>& candidates,
                  const PointThresholds& thresholds)
      : fitter_(fitter), candidates_(candidates), limits_(thresholds) {}

  const PointFitter& fitter() const { return fitter_; }
  const std::vector<PointCandidate>& candidates() const { return candidates_; }
  const PointThresholds& limits() const { return limits_; }
  std::size_t index_of(std::string_view effect) const;
  const PointCandidate& candidate(std::string_view effect) const { return candidates_[index_of(effect)]; }

  /// A model fitted to all points and to both halves; nothing if it has no torques.
  std::optional<FittedModel> fitted(const PointModel& model, const std::vector<std::vector<double>>& starts) const;
  /// The same to all points only, with little effort.
  std::optional<FittedModel> glanced(const FittedModel& model, const PointCandidate& candidate) const;
  /// A model with one more effect, or one less.
  std::optional<FittedModel> extended(const FittedModel& model, const PointCandidate& candidate) const;
  std::optional<FittedModel> reduced(const FittedModel& model, const PointCandidate& candidate) const;
  /// A model again, started from the values of a wider one.
  std::optional<FittedModel> again(const FittedModel& model, const FittedModel& wider) const;

  /// Whether an effect can be added to a model.
  bool fits_beside(const PointCandidate& candidate, const PointModel& model) const;
  /// Why a model cannot be believed; empty if it can.
  std::string doubt(const FittedModel& model) const;

 private:
  PointModel wider(const FittedModel& model, const PointCandidate& candidate,
                   std::vector<std::vector<double>>& starts) const;
  FittedModel judged(const PointModel& model, PointFit all, double held_out) const;

  const PointFitter& fitter_;
  const std::vector<PointCandidate>& candidates_;
  const PointThresholds& limits_;
};

}  // namespace wormdrive
