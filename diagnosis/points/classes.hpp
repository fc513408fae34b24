#pragma once
#include <vector>

#include "diagnosis/points/comparison.hpp"

namespace wormdrive {

/// Candidates that can stand for each other in a model, by index, named ones first: one in the place of another
/// explains the points as well, or the signature of a named one can be imitated by the other named ones. Classes that
/// share a member are one.
std::vector<std::vector<std::size_t>> equivalence_classes(const PointComparison& comparison, const FittedModel& model);

}  // namespace wormdrive
