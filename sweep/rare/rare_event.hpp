#pragma once
#include <optional>
#include <string>

#include "sweep/rare/design_point.hpp"
#include "sweep/rare/drive_limit.hpp"
#include "sweep/rare/subset_simulation.hpp"
#include "sweep/trial.hpp"

namespace wormdrive {

struct RareSettings {
  std::string metric;              ///< of the threshold; empty: that of the first one
  std::uint64_t per_level = 2000;  ///< points of a level of the subset simulation
  std::uint64_t samples = 2000;    ///< of importance sampling
  unsigned threads = 1;
  KeptRuns kept{};  ///< nothing for none
};

/// How rarely drives of a study miss a limit, by two methods that share the simulation of a drive and nothing else.
struct RareEvent {
  Threshold threshold;
  bool median_misses = false;  ///< then a miss is not rare, and there is no design point
  SubsetResult subset;
  DesignPoint design;
  Trial likely;             ///< the drive at the design point
  RareEstimate importance;  ///< around the design point

  /// Whether the intervals of both methods overlap.
  bool agrees() const { return subset.estimate.low <= importance.high && importance.low <= subset.estimate.high; }
  /// Trials that plain sampling takes for the variation that the subset simulation has.
  double plain_trials() const;
};

/// The limit of a study by its metric, the first one if empty. Throws InputFault where there is none, or where no
/// distributions say what is rare; path: its file.
const Threshold& limit_of(const Study& study, const std::string& path, const std::string& metric);

/// How many runs an estimate takes at most.
std::uint64_t most_runs(const Study& study, const RareSettings& settings);

/// Estimates the probability with which the drives of a study miss one of its limits; the same for any number of
/// threads. Throws InputFault where the study states no such limit, or where its metric does not tell how near a drive
/// comes to it.
RareEvent estimate_rare_event(const Study& study, const std::string& path, const RareSettings& settings);

}  // namespace wormdrive
