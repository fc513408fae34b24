#pragma once
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "sweep/statistics.hpp"
#include "sweep/sweep_file.hpp"

namespace wormdrive {

inline constexpr double summary_quantiles[] = {0.05, 0.5, 0.95, 0.99};

/// How a metric is distributed over the trials that are done, and finite.
struct MetricSummary {
  Metric metric;
  std::uint64_t count{};
  double mean{}, deviation{}, least{}, greatest{};
  std::vector<Estimate> quantiles;  ///< of summary_quantiles
};

/// How often a threshold is missed by the trials that are done.
struct ThresholdSummary {
  Threshold threshold;
  Unit unit;
  std::uint64_t missed{}, of{};
  Estimate share{};
};

/// How much a parameter matters for the metric by which trials are ranked.
struct Influence {
  std::string parameter;
  double rank_correlation{};
  std::optional<SobolIndex> sobol;
  double size() const { return sobol ? sobol->total.value : std::abs(rank_correlation); }
};

/// A condition of Lemma 1 that does not hold for the values of some trials.
struct FailedCondition {
  std::string rule;
  std::uint64_t trials{}, of{};
};

/// What a sweep comes to.
struct SweepSummary {
  std::uint64_t trials{}, done{}, refused{}, halted{};
  bool sample = true;  ///< shares are probabilities, for the design is a sample
  std::vector<MetricSummary> metrics;
  std::vector<ThresholdSummary> thresholds;
  std::string ranked_by;
  std::vector<Influence> influences;  ///< greatest first
  std::vector<Trial> worst;           ///< greatest first
  std::vector<FailedCondition> conditions;
};

/// Throws InputFault if the metric by which trials are to be ranked does not exist; empty: that of the first threshold,
/// else the first one.
SweepSummary summarise(const SweepReader& sweep, const std::string& ranked_by, unsigned worst);

}  // namespace wormdrive
