#pragma once
#include <cstdint>
#include <vector>

#include "statistics/column.hpp"
#include "sweep/study/design.hpp"
#include "sweep/summary/statistics.hpp"

namespace wormdrive {

/// What the elementary effects of a parameter come to: changes of a metric over changes of the probability below the
/// parameter's value, one from each trajectory.
struct ElementaryEffects {
  double mu{};               ///< mean
  SampleEstimate mu_star{};  ///< mean of the absolute effects [Campolongo2007]; interval of Student's t
  double sigma{};            ///< standard deviation: of interaction and curvature
};

/// Those of every parameter, in their order.
struct MorrisScreening {
  std::vector<ElementaryEffects> of;  ///< none if fewer than two trajectories are left
  std::uint64_t used{}, left_out{};   ///< trajectories; those are left out of which a value is not finite
};

/// Elementary effects [Morris1991] of a study whose design is Morris: values of one metric in the order of its trials,
/// from the first one on.
MorrisScreening elementary_effects(const Column& values, const DesignSettings& design, std::size_t parameters,
                                   std::uint64_t seed);

}  // namespace wormdrive
