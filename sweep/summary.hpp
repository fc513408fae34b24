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
  std::vector<SampleEstimate> quantiles;  ///< of summary_quantiles
};

/// How often a threshold is missed by the trials that are done.
struct ThresholdSummary {
  Threshold threshold;
  Unit unit;
  std::uint64_t missed{}, of{};
  SampleEstimate share{};
};

/// How much a parameter matters for the metric by which trials are ranked.
struct Influence {
  std::string parameter;
  double rank_correlation{};
  std::optional<SobolIndex> sobol;
  double size() const { return sobol ? sobol->total.value : std::abs(rank_correlation); }
};

/// For the values of how many trials a condition of Lemma 1 does not hold.
struct ConditionSummary {
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
  std::vector<Influence> influences;         ///< greatest first
  std::vector<Trial> worst;                  ///< greatest first
  std::vector<ConditionSummary> conditions;  ///< every one, in the order of the metrics

  std::uint64_t with(TrialStatus status) const {
    switch (status) {
      case TrialStatus::done: return done;
      case TrialStatus::refused: return refused;
      case TrialStatus::halted: return halted;
    }
    return 0;
  }
};

/// The metric by which trials are ranked unless somebody asks for another one: that of the first threshold, else the
/// first one with a unit, else the first one.
std::string default_ranking(const Study& study);

/// +1 where the greatest values of a metric are the worst, -1 where the least are: where a threshold is missed below.
double worse(const Study& study, const std::string& metric);

/// Throws InputFault if the metric by which trials are to be ranked does not exist; empty: the default.
SweepSummary summarise(const SweepReader& sweep, const std::string& ranked_by, unsigned worst);

}  // namespace wormdrive
