#pragma once
#include <string>
#include <vector>

#include "recovery/campaign.hpp"

namespace recovery {

/// What a logger does to a recording.
struct Logging {
  double jitter = 0.0;   ///< most by which a sample is early or late [periods]
  double missing = 0.0;  ///< share of the rows
  std::size_t run = 1;   ///< rows that are lost together
};

/// The same bench, as a logger wrote it and as it should have.
struct Logged {
  Case bench;
  Logging logging;
  Outcome clean{}, uneven{};

  /// Whether both logs have the same answer: the same names, and something left or not.
  bool agree() const;
};

/// Rates of 100 Hz to 10 kHz, with jitter of 1 to 20 %, 0.1 to 5 % of the rows missing, and both, in turn; on every
/// other bench of the plan nothing is hidden.
std::vector<Logged> logs(const Plan& plan, const Diagnose& diagnose, int threads);

/// A table in Markdown.
std::string table(const std::vector<Logged>& logged);

}  // namespace recovery
