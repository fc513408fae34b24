#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "sweep/file/sweep_file.hpp"

namespace wormdrive {

struct WorstCaseSettings {
  std::string metric;               ///< empty: the one by which trials are ranked
  std::uint64_t evaluations = 400;  ///< trials that are made at most, four or more
  double tail = 1e-3;               ///< probability that is left out at either end of each parameter
  unsigned threads = 1;
  bool done_only = false;  ///< among drives that run to the end; else one that does not is the worst
};

/// The worst drive that was found in the uncertain box. Nothing is worse than one that cannot run, does not come to its
/// end or has no value of the metric.
struct WorstCase {
  std::string metric;
  Trial before;  ///< the sweep's worst
  std::uint64_t evaluations{};
  Trial found;        ///< its noise is that of the trial of its index
  Scenario scenario;  ///< of what was found
};

/// Searches the box of the uncertain parameters for the worst value of a metric: the whole of it by controlled random
/// search [Kaelo2006], and from there as from the sweep's worst trials on by subplex searches [Rowan1990]. Each has the
/// noise of one of these trials, and all find the same for any number of threads. Where
/// nothing can be worse than the sweep's worst, that is the answer. Throws InputFault if the sweep has no trial from
/// which a search could start, or not the metric.
WorstCase find_worst(const SweepReader& sweep, const WorstCaseSettings& settings);

}  // namespace wormdrive
