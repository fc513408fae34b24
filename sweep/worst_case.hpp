#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "sweep/sweep_file.hpp"

namespace wormdrive {

struct WorstCaseSettings {
  std::string metric;               ///< empty: the one by which trials are ranked
  std::uint64_t evaluations = 400;  ///< trials that are made at most
  double tail = 1e-3;               ///< probability that is left out at either end of each parameter
  unsigned threads = 1;
};

/// The worst drive that was found in the uncertain box.
struct WorstCase {
  std::string metric;
  Unit unit;
  double value{}, before{};  ///< of the metric, and of the sweep's worst trial
  std::uint64_t trial{};     ///< the sweep's worst one
  std::uint64_t evaluations{};
  std::vector<double> point;  ///< of the unit cube
  Trial found;
};

/// Searches the box of the uncertain parameters for the worst value of a metric, by subplex searches [Rowan1990] from
/// the sweep's worst trials on; the same for any number of threads. Throws InputFault if the sweep has no trial that is
/// done, or not the metric.
WorstCase find_worst(const SweepReader& sweep, const WorstCaseSettings& settings);

}  // namespace wormdrive
