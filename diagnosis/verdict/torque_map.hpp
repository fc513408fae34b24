#pragma once
#include <optional>

#include "diagnosis/candidates/magnitudes.hpp"
#include "diagnosis/fitting/hypothesis.hpp"

namespace wormdrive {

/// A torque on a shaft over one axis, learned from what a hypothesis leaves unexplained. It claims no cause.
struct LearnedMap {
  Hypothesis model;     ///< with the map among its effects
  double without{};     ///< error ahead on data that nothing was fitted to, at the reported horizon [rad] ...
  double with{};        ///< ... and the same with the map
  double smoothness{};  ///< that the data asked for; see refined_map()
};

/// Learns maps over the worm's speed and over the gear's angle on either shaft, from as few points and as smooth as
/// predicts best what a map was not fitted to; gives the one with the smallest error ahead. Nothing where none lowers
/// that error by more than is of no account, or the scenario states a map itself.
std::optional<LearnedMap> learned_map(const Evaluation& evaluation, const Hypothesis& h, const Magnitudes& sizes);

/// The same map with its values fitted to other data.
Hypothesis refined_map(const Evaluation& evaluation, const LearnedMap& map, Hypothesis h, const Magnitudes& sizes);

}  // namespace wormdrive
