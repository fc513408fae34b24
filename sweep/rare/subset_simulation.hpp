#pragma once
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "sweep/rare/limit_state.hpp"

namespace wormdrive {

struct SubsetSettings {
  std::uint64_t per_level = 2000;  ///< points of each level, of which a tenth begin chains
  std::uint64_t seed = 1;
  std::size_t most_levels = 16;  ///< beyond 1e-16 probabilities of parameters are rounding
};

/// One level: the share of its points that come nearer to the limit than the next threshold.
struct SubsetLevel {
  double threshold = 0.0;  ///< of the limit state
  double share = 0.0;
  double variation = 0.0;   ///< of the share, the correlation along the chains included
  double acceptance = 1.0;  ///< share of the proposals that were taken
};

struct SubsetResult {
  RareEstimate estimate;
  std::vector<SubsetLevel> levels;
};

/// The probability to come nearer to the limit than the last of some levels, from the first on; without evaluations.
RareEstimate estimate_within(std::span<const SubsetLevel> levels);

/// How often it evaluates the limit state at most.
std::uint64_t most_evaluations(const SubsetSettings& settings);

/// Subset simulation [AuBeck2001]: a small probability as a product of shares around 0.1, each estimated from Markov
/// chains that start in the level before, by conditional sampling with an adaptive step [Papaioannou2015, sec. 4.2].
/// The same for any number of threads. Throws PlateauFault where the limit state has no more values between the points
/// and the limit.
SubsetResult subset_simulation(const LimitState& limit_state, std::size_t dimensions, const SubsetSettings& settings);

/// The limit state does not tell how near a drive comes.
struct PlateauFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace wormdrive
