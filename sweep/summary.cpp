#include "sweep/summary.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "scenarios/faults.hpp"
#include "scenarios/keys.hpp"
#include "sweep/order_statistics.hpp"
#include "sweep/rank_correlation.hpp"

namespace wormdrive {
namespace {

/// Goes through the columns of a sweep in parts, as often as it takes: memory does not grow with the trials.
class Summariser {
 public:
  Summariser(const SweepReader& sweep, const std::string& ranked_by) : sweep_(sweep), study_(sweep.study()) {
    std::vector<std::string> names;
    for (const Metric& metric : study_.metrics) names.push_back(metric.name);
    ranked_by_ = ranked_by.empty() ? default_ranking(study_) : ranked_by;
    if (std::find(names.begin(), names.end(), ranked_by_) == names.end())
      refuse({sweep.path()}, "has no metric '" + ranked_by_ + "'; " + suggestion(ranked_by_, names));
    if (std::holds_alternative<Saltelli>(study_.design)) stride_ = study_.parameters.size() + 2;
  }

  SweepSummary operator()(unsigned worst) {
    SweepSummary summary;
    summary.trials = sweep_.trials();
    count_statuses(summary);
    summary.sample = is_sample(study_.design);
    summary.ranked_by = ranked_by_;
    for (const Metric& metric : study_.metrics) {
      summary.metrics.push_back(distribution(metric));
      count_misses(metric, summary);
    }
    influences(summary);
    find_worst(worst, summary);
    return summary;
  }

 private:
  using Block = SweepReader::Block;

  /// Whether a trial stands for the distribution of the parameters: in a Saltelli design A and B alone do.
  bool counts(std::uint64_t trial) const { return stride_ == 1 || trial % stride_ < 2; }
  static bool done(const Block& block, std::size_t row) {
    return block.status[row] == static_cast<double>(TrialStatus::done);
  }

  void count_statuses(SweepSummary& summary) const {
    sweep_.for_each_block({}, [&](const Block& block) {
      for (const double status : block.status) {
        summary.done += status == static_cast<double>(TrialStatus::done);
        summary.refused += status == static_cast<double>(TrialStatus::refused);
        summary.halted += status == static_cast<double>(TrialStatus::halted);
      }
    });
  }

  /// Rows of columns at trials that are done, stand for the distribution and have a finite metric, the first column.
  template <class Take>
  void for_each_finite(const std::vector<std::string>& names, Take&& take) const {
    std::vector<std::vector<double>> chosen(names.size());
    sweep_.for_each_block(names, [&](const Block& block) {
      for (std::vector<double>& column : chosen) column.clear();
      for (std::size_t row = 0; row < block.status.size(); ++row)
        if (counts(block.first + row) && done(block, row) && std::isfinite(block.columns.front()[row]))
          for (std::size_t k = 0; k < names.size(); ++k) chosen[k].push_back(block.columns[k][row]);
      take(chosen);
    });
  }
  /// A column where a metric is finite.
  Column where_finite(const std::string& metric, const std::string& name) const {
    return [this, metric, name](const TakeValues& take) {
      const std::vector<std::string> names = name == metric ? std::vector{metric} : std::vector{metric, name};
      for_each_finite(names, [&](const auto& chosen) { take(chosen.back()); });
    };
  }

  MetricSummary distribution(const Metric& metric) const {
    MetricSummary summary;
    summary.metric = metric;
    summary.least = std::numeric_limits<double>::infinity();
    summary.greatest = -summary.least;
    const Column column = where_finite(metric.name, metric.name);
    double squares = 0.0;  // of distances from the mean so far, after Welford
    column([&](std::span<const double> values) {
      for (const double value : values) {
        const double distance = value - summary.mean;
        summary.mean += distance / static_cast<double>(++summary.count);
        squares += distance * (value - summary.mean);
        summary.least = std::min(summary.least, value);
        summary.greatest = std::max(summary.greatest, value);
      }
    });
    if (summary.count == 0) return summary;
    summary.deviation = summary.count > 1 ? std::sqrt(squares / static_cast<double>(summary.count - 1)) : 0.0;

    std::set<std::uint64_t> wanted;
    for (const double p : summary_quantiles)
      sample_quantile(quantile_ranks(summary.count, p), [&](std::uint64_t rank) {
        wanted.insert(rank);
        return 0.0;
      });
    const auto values = order_statistics(column, summary.count, wanted);
    for (const double p : summary_quantiles)
      summary.quantiles.push_back(
          sample_quantile(quantile_ranks(summary.count, p), [&](std::uint64_t rank) { return values.at(rank); }));
    return summary;
  }

  /// How often a metric misses its thresholds, or the condition of Lemma 1 fails whose margin it is.
  void count_misses(const Metric& metric, SweepSummary& summary) const {
    std::vector<ThresholdSummary> thresholds;
    for (const Threshold& threshold : study_.thresholds)
      if (threshold.metric == metric.name) thresholds.push_back({threshold, metric.unit, 0, 0, {}});
    const bool is_condition = metric.name.starts_with("condition_");
    if (thresholds.empty() && !is_condition) return;
    ConditionSummary condition{metric.meaning, 0, 0};
    sweep_.for_each_block({metric.name}, [&](const Block& block) {
      for (std::size_t row = 0; row < block.status.size(); ++row) {
        if (!counts(block.first + row) || !done(block, row)) continue;
        const double value = block.columns.front()[row];
        ++condition.of;
        if (value < 0.0) ++condition.trials;
        for (ThresholdSummary& t : thresholds)
          if (t.threshold.missed_by(value)) ++t.missed;
      }
    });
    for (ThresholdSummary& t : thresholds) {
      t.of = condition.of;
      t.share = probability(t.missed, t.of);
      summary.thresholds.push_back(t);
    }
    if (is_condition) summary.conditions.push_back(condition);
  }

  void influences(SweepSummary& summary) const {
    std::vector<SobolIndex> sobol;
    if (stride_ > 1 && sweep_.range().first == 0)
      sobol = sobol_indices(of_all_trials(), study_.parameters.size(), study_.seed);
    const std::uint64_t count = std::find_if(summary.metrics.begin(), summary.metrics.end(), [&](const auto& m) {
                                  return m.metric.name == ranked_by_;
                                })->count;
    const RankScale metric(where_finite(ranked_by_, ranked_by_), count);
    for (std::size_t k = 0; k < study_.parameters.size(); ++k) {
      const std::string& name = study_.parameters[k].name;
      Influence influence{study_.parameters[k].path, 0.0, {}};
      influence.rank_correlation = rank_correlation(
          [&](const TakePairs& take) {
            for_each_finite({ranked_by_, name}, [&](const auto& chosen) { take(chosen.front(), chosen.back()); });
          },
          metric, RankScale(where_finite(ranked_by_, name), count));
      if (!sobol.empty()) influence.sobol = sobol[k];
      summary.influences.push_back(std::move(influence));
    }
    std::stable_sort(summary.influences.begin(), summary.influences.end(),
                     [](const Influence& a, const Influence& b) { return a.size() > b.size(); });
  }
  /// The metric by which trials are ranked, not a number where a trial is missing or not done.
  Column of_all_trials() const {
    return [this](const TakeValues& take) {
      sweep_.for_each_block({ranked_by_}, [&](const Block& block) {
        std::vector<double> values = block.columns.front();
        for (std::size_t row = 0; row < values.size(); ++row)
          if (!done(block, row)) values[row] = std::numeric_limits<double>::quiet_NaN();
        take(values);
      });
    };
  }

  void find_worst(unsigned worst, SweepSummary& summary) const {
    const double sign = worse(study_, ranked_by_);
    std::set<std::pair<double, std::uint64_t>> first;  // the worst first, of equals the earlier
    sweep_.for_each_block({ranked_by_}, [&](const Block& block) {
      for (std::size_t row = 0; row < block.status.size(); ++row) {
        const double value = block.columns.front()[row];
        if (!done(block, row) || !std::isfinite(value)) continue;
        if (first.size() == worst && (worst == 0 || -sign * value >= first.rbegin()->first)) continue;
        first.emplace(-sign * value, block.first + row);
        if (first.size() > worst) first.erase(std::prev(first.end()));
      }
    });
    for (const auto& [value, trial] : first) summary.worst.push_back(sweep_.read({trial, trial + 1}).front());
  }

  const SweepReader& sweep_;
  const Study& study_;
  std::string ranked_by_;
  std::size_t stride_ = 1;
};

}  // namespace

std::string default_ranking(const Study& study) {
  if (!study.thresholds.empty()) return study.thresholds.front().metric;
  const auto with_unit = std::find_if(study.metrics.begin(), study.metrics.end(), [](const Metric& metric) {
    return metric.unit.symbol != unit::none.symbol;  // many trials count the same events: no rank tells them apart
  });
  return (with_unit != study.metrics.end() ? *with_unit : study.metrics.front()).name;
}

double worse(const Study& study, const std::string& metric) {
  const bool below = std::any_of(study.thresholds.begin(), study.thresholds.end(),
                                 [&](const Threshold& t) { return t.metric == metric && !t.above; });
  return below ? -1.0 : 1.0;
}

SweepSummary summarise(const SweepReader& sweep, const std::string& ranked_by, unsigned worst) {
  return Summariser(sweep, ranked_by)(worst);
}

}  // namespace wormdrive
