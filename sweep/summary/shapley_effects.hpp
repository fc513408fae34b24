#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "statistics/column.hpp"
#include "sweep/study/design.hpp"
#include "sweep/summary/statistics.hpp"

namespace wormdrive {

/// What share of a metric's variance a parameter makes, whether others depend on it or not.
struct ShapleyEffect {
  SampleEstimate share;  ///< shares add up to 1: what several do together is theirs in equal parts [Owen2014]
  /// Sobol indices [Kucherenko2012]: what is explained once this parameter alone is known, with all that it tells of
  /// the others, and what remains where all others are known. None if it comes first, or last, in fewer than two
  /// permutations.
  std::optional<SampleEstimate> first, total;
};

/// Shapley effects of every parameter, in their order.
struct ShapleyEffects {
  std::vector<ShapleyEffect> of;     ///< none if fewer than two permutations are left or the metric is constant
  std::uint64_t used{}, left_out{};  ///< permutations; those are left out of which a value is not finite
};

/// Those of a study whose design is Shapley: values of one metric in the order of its trials, from the first one on.
/// Intervals are those of Student's t for a ratio of means over the permutations, of the total index on its logarithm.
ShapleyEffects shapley_effects(const Column& values, const DesignSettings& design, std::size_t parameters,
                               std::uint64_t seed);

}  // namespace wormdrive
