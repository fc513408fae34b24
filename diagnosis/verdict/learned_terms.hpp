#pragma once
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/learned/map_fit.hpp"
#include "diagnosis/verdict/learned_vibration.hpp"

namespace wormdrive {

/// What was learned from what a hypothesis leaves unexplained: maps of torque, friction and load, each over one axis,
/// and a vibration. None of them claims a cause.
struct LearnedTerms {
  Hypothesis model;  ///< with them among its effects
  std::vector<LearnedMap> maps{};
  std::optional<LearnedVibration> vibration{};
  double without{};  ///< error ahead on data that nothing was fitted to, at the reported horizon [rad] ...
  double with{};     ///< ... and the same with them
};

/// Learns term by term, each time the one with the smallest error ahead beside those before it, as long as that lowers
/// the error by more than is of no account and leaves a drive that can move. Blocks have to show it beyond chance, or
/// the parts of the data that a map was not fitted to. Nothing where no term does.
std::optional<LearnedTerms> learned_terms(const Evaluation& evaluation, const Hypothesis& h, const Magnitudes& sizes);

/// The same terms beside another hypothesis, with their numbers fitted to its data; as they are where these would leave
/// a drive that cannot move.
Hypothesis refined_terms(const Evaluation& evaluation, const LearnedTerms& terms, const Hypothesis& h,
                         const Magnitudes& sizes);

}  // namespace wormdrive
