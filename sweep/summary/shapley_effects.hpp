#pragma once
#include <cstdint>
#include <vector>

#include "statistics/column.hpp"
#include "sweep/study/design.hpp"
#include "sweep/summary/statistics.hpp"

namespace wormdrive {

/// Shapley effects of every parameter, in their order: shares of a metric's variance that add up to 1, whether the
/// parameters depend on each other or not. What several do together is shared out among them equally [Owen2014].
struct ShapleyEffects {
  std::vector<SampleEstimate> of;    ///< none if fewer than two permutations are left or the metric is constant
  std::uint64_t used{}, left_out{};  ///< permutations; those are left out of which a value is not finite
};

/// Those of a study whose design is Shapley: values of one metric in the order of its trials, from the first one on.
/// Intervals are those of Student's t for a ratio of means over the permutations.
ShapleyEffects shapley_effects(const Column& values, const DesignSettings& design, std::size_t parameters,
                               std::uint64_t seed);

}  // namespace wormdrive
