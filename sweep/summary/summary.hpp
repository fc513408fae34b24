#pragma once
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sweep/file/sweep_file.hpp"
#include "sweep/summary/elementary_effects.hpp"
#include "sweep/summary/shapley_effects.hpp"
#include "sweep/summary/sobol_indices.hpp"
#include "sweep/summary/statistics.hpp"

namespace wormdrive {

inline constexpr double summary_quantiles[] = {0.05, 0.5, 0.95, 0.99};

/// How the values of a metric are ordered, those of trials included that have none: these are the worst.
struct Ranking {
  double sign;     ///< +1 where the greatest values are the worst, -1 where the least are
  double missing;  ///< what a trial counts as that is done and has no value

  double worst() const { return sign * std::numeric_limits<double>::infinity(); }
  /// What a trial counts as; it is worst if it was refused or halted.
  double operator()(double value, bool done) const { return !done ? worst() : std::isnan(value) ? missing : value; }
};

/// How a metric is distributed over the trials.
struct MetricSummary {
  Metric metric;
  std::uint64_t count{}, without{};  ///< trials with a finite value; others, which count as their ranking says
  double mean{}, deviation{}, least{}, greatest{};  ///< of the finite values
  std::vector<SampleEstimate> quantiles;            ///< of summary_quantiles, over all trials

  /// Whether several trials all have the same value.
  bool is_constant() const { return count > 1 && without == 0 && least == greatest; }
};

/// How often a threshold is missed.
struct ThresholdSummary {
  Threshold threshold;
  Unit unit;
  std::uint64_t missed{};             ///< trials that are done and do not keep the limit
  std::uint64_t refused{}, halted{};  ///< trials of which nothing is known but that
  std::uint64_t of{};                 ///< all of them
  SampleEstimate share{};             ///< of those that miss it
  SampleEstimate not_kept{};          ///< of those that miss it, were refused or halted

  std::uint64_t kept() const { return of - missed - refused - halted; }
};

/// How much a parameter matters for the metric by which trials are ranked.
struct Influence {
  std::string parameter;
  SampleEstimate rank_correlation{};
  std::optional<SobolIndex> sobol;
  std::optional<ElementaryEffects> effects;  ///< of a Morris design
  std::optional<ShapleyEffect> shapley;      ///< of a Shapley design
  double size() const {
    return sobol     ? sobol->total.value
           : effects ? effects->mu_star.value
           : shapley ? shapley->share.value
                     : std::abs(rank_correlation.value);
  }
};

/// For the values of how many trials that are done a condition of Lemma 1 does not hold.
struct ConditionSummary {
  std::string rule;  ///< in words
  std::uint64_t trials{}, of{};
};

/// What a sweep comes to.
struct SweepSummary {
  std::uint64_t trials{}, done{}, refused{}, halted{};
  std::uint64_t draws{};   ///< that are not left out; of these alone metrics and thresholds tell
  bool sample = true;      ///< shares are probabilities, for the design is a sample; else nothing has an interval
  bool done_only = false;  ///< refused and halted trials are left out of all below
  std::vector<MetricSummary> metrics;
  std::vector<ThresholdSummary> thresholds;
  std::string ranked_by;
  std::vector<Influence> influences;  ///< greatest first
  /// Elementary effects of every metric, in their order, on parameters as the study states them; none of another
  /// design than Morris.
  std::vector<MorrisScreening> screenings;
  std::vector<ShapleyEffects> shapley;       ///< the same of a Shapley design
  SobolIndices sobol;                        ///< of the parameters as the study states them; none of another design
  std::vector<Trial> worst;                  ///< the worst first
  std::vector<ConditionSummary> conditions;  ///< every one, in the order of the metrics

  /// What every metric has, of one of them; null if there is none.
  template <class PerMetric>
  const PerMetric* find(const std::vector<PerMetric>& of_metrics, const std::string& metric) const {
    for (std::size_t k = 0; k < of_metrics.size(); ++k)
      if (metrics[k].metric.name == metric) return &of_metrics[k];
    return nullptr;
  }
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

Ranking ranking_of(const Study& study, const std::string& metric);

struct SummarySettings {
  std::string ranked_by = {};  ///< metric by which trials are ranked; empty: the default
  unsigned worst = 5;          ///< trials that are listed
  bool done_only = false;      ///< leave out refused and halted trials, which else count as the worst
};

/// Works it out from the trials. Throws InputFault if the metric by which trials are to be ranked does not exist.
SweepSummary summarise(const SweepReader& sweep, const SummarySettings& settings);

/// The same as /summary of a complete sweep tells it, whatever the number of trials; nothing where that holds other
/// things than are asked for: another ranking, more of the worst trials, indices of a design that is made for them.
std::optional<SweepSummary> stored_summary(const SweepReader& sweep, const SummarySettings& settings);
/// As stored, or else worked out.
SweepSummary summary_of(const SweepReader& sweep, const SummarySettings& settings);

}  // namespace wormdrive
