#pragma once
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/points/candidates.hpp"

namespace wormdrive {

/// A model with its fits.
struct FittedModel {
  PointModel model;
  PointFit all;
  double bic = 0.0;
  double doubt = 0.0;     ///< what it costs that stated parameters lie far outside their tolerance, in units of BIC
  double held_out = 0.0;  ///< negative log likelihood of both halves, each by the fit of the other [nats]

  double rank() const { return bic + doubt; }
};

/// A model with one effect in the place of one that it named, both by index.
struct Exchange {
  std::size_t dropped, taken;
  FittedModel model;
};

/// Fits models and compares them: what selection and classes have in common.
class PointComparison {
 public:
  PointComparison(const PointFitter& fitter, const std::vector<PointCandidate>& candidates)
      : fitter_(fitter), candidates_(candidates) {}

  const PointFitter& fitter() const { return fitter_; }
  const std::vector<PointCandidate>& candidates() const { return candidates_; }
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
  /// Every model that explains the points as well as another after an exchange of one effect, and can be believed.
  std::vector<Exchange> exchanges(const FittedModel& model) const;

  /// Whether an effect can be added to a model.
  bool fits_beside(const PointCandidate& candidate, const PointModel& model) const;
  /// Why a model cannot be believed; empty if it can.
  std::string doubt(const FittedModel& model) const;
  /// Whether its friction falls below zero at some speed, so that it cannot be simulated, or rises where it is named
  /// for its fall.
  bool misshapen(const FittedModel& model) const;

 private:
  PointModel wider(const FittedModel& model, const PointCandidate& candidate,
                   std::vector<std::vector<double>>& starts) const;
  FittedModel judged(const PointModel& model, PointFit all, double held_out) const;
  FrictionRange friction(const Effects<double>& effects) const;
  FrictionRange friction(const FittedModel& model) const;

  const PointFitter& fitter_;
  const std::vector<PointCandidate>& candidates_;
};

}  // namespace wormdrive
