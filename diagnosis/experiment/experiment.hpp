#pragma once
#include <optional>
#include <string>
#include <vector>

#include "description/scenario.hpp"
#include "diagnosis/candidates/catalogue.hpp"
#include "diagnosis/candidates/magnitudes.hpp"
#include "diagnosis/data/recording.hpp"

namespace wormdrive {

/// What a run of a scenario with a controller writes down. Throws SimulationFailure.
Recording simulated(const Scenario& scenario);

/// A scenario that would tell a class of causes apart, and why.
struct Experiment {
  std::optional<Scenario> scenario;  ///< nothing: none of those tried out would
  std::string reason;                ///< a sentence
};

/// Chooses among a few motions, with the payload as it is and doubled, the one whose simulated recording tells the
/// members of a class apart best, by its certificate. extended: the scenario with the first member as it was found, at
/// its size; nameable means that this size could be told from every other member.
Experiment splitting_experiment(const Scenario& extended, const Scenario& stated, const std::vector<Candidate>& members,
                                double size, const std::vector<Coordinate>& toleranced, const Magnitudes& sizes,
                                double excursion, int threads);

}  // namespace wormdrive
