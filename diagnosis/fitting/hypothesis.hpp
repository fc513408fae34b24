#pragma once
#include <limits>
#include <string_view>
#include <vector>

#include "diagnosis/candidates/catalogue.hpp"
#include "diagnosis/fitting/evaluation.hpp"

namespace wormdrive {

/// A model of the data: the scenario with some candidates, what of it is free, and how well it does.
struct Hypothesis {
  std::vector<std::size_t> causes{};  ///< candidates that are in it, by their index
  RecordedDrive drive{};              ///< with what is chosen; the free coordinates are set by extended()
  std::vector<Coordinate> free{};
  std::vector<double> values{};  ///< of the free coordinates
  ProcessNoise noise{};
  bool whitens = true;
  double choices = 0.0;  ///< what trying out has cost, as BIC

  // what evaluate() finds
  std::vector<double> innovations{}, residuals{};  ///< as they are, and whitened [rad]
  NoiseModel noise_model{};
  Misfit misfit{};
  double objective =
      std::numeric_limits<double>::infinity();  ///< misfit of the fitted data and of the tolerances [nats]
  double bic = std::numeric_limits<double>::infinity();
};

/// What is stated: these effects, with the numbers that have a tolerance free at their stated values. To be evaluated.
Hypothesis stated_hypothesis(const Effects<double>& effects, const std::vector<Coordinate>& stated);

/// Drive and recording with the free coordinates at their values.
RecordedDrive extended(const Hypothesis& h);

/// The same with white noise alone, which takes no slow structure for its own. To be evaluated.
Hypothesis without_noise_model(Hypothesis h);

/// A misfit with what the free coordinates are off, by their tolerances [nats].
double with_tolerances(double misfit, const Hypothesis& h);

/// Predicts the data by a hypothesis and judges it; false where the model cannot move so (the objective is infinite).
bool evaluate(const Evaluation& evaluation, Hypothesis& h);

/// Adds a candidate from one of its starts, or from one of its far values, which are counted on from the starts. A
/// coordinate that is free already loses its tolerance, and keeps its value but for a far one.
void add_candidate(Hypothesis& h, const std::vector<Candidate>& all, std::size_t candidate, std::size_t start);

/// Index of a coordinate among the free ones, -1 where it is fixed.
int index_of(const Hypothesis& h, const Coordinate& coordinate);
/// The same of a field that is a coordinate as it stands.
int index_of(const Hypothesis& h, std::string_view effect, std::string_view field);

/// Change of the whitened innovations by a change of one free coordinate, per scale; clipped where it is beyond all
/// proportion to the noise. step: in scales, its sign is turned where it would leave the bounds.
std::vector<double> sensitivity(const Evaluation& evaluation, const Hypothesis& h, std::size_t coordinate, double step);

/// Whitened innovations of a model less those of a hypothesis, with the noise model of the latter, clipped likewise.
std::vector<double> difference(const Evaluation& evaluation, const Hypothesis& h,
                               const std::vector<double>& innovations);

/// Torque that the motor gives over the one that was recorded: the gain that a model has.
double torque_per_recorded(const Hypothesis& h);

/// Inertia that the motor moves in a recording, counted at the gear as a torque on the worm, Jw i + C(0) Jg [kg m^2].
double inertia_on_worm(const Evaluation& evaluation, const Hypothesis& h, std::size_t recording);

}  // namespace wormdrive
