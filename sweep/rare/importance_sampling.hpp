#pragma once
#include "sweep/rare/limit_state.hpp"

namespace wormdrive {

struct ImportanceSettings {
  std::uint64_t samples = 2000;
  std::uint64_t seed = 1;
  std::uint64_t first = 0;  ///< index of the first sample
};

/// The probability from samples around a point, weighted by how much rarer they are than there. Unbiased wherever the
/// point is, but blind for parts of the miss that lie far from it.
///
/// Source: [SchuellerStix1987].
RareEstimate importance_sampling(const LimitState& limit_state, const NormalPoint& around,
                                 const ImportanceSettings& settings);

}  // namespace wormdrive
