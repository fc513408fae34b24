#include "sweep/summary/summary.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "description/diagnostics.hpp"
#include "description/keys.hpp"
#include "statistics/held_column.hpp"
#include "statistics/moments.hpp"
#include "statistics/order_statistics.hpp"
#include "statistics/rank_correlation.hpp"

namespace wormdrive {
namespace {

/// Goes through the columns of a sweep in parts, as often as it takes: of trials beyond millions memory does not grow.
class Summariser {
 public:
  Summariser(const SweepReader& sweep, const SummarySettings& settings)
      : sweep_(sweep),
        study_(sweep.study()),
        settings_(settings),
        together_(block_of(study_.design, study_.parameters.size())) {
    std::vector<std::string> names;
    for (const Metric& metric : study_.metrics) names.push_back(metric.name);
    if (settings_.ranked_by.empty()) settings_.ranked_by = default_ranking(study_);
    if (std::find(names.begin(), names.end(), settings_.ranked_by) == names.end())
      reject({sweep.path()}, "has no metric '" + settings_.ranked_by + "'; " + suggestion(settings_.ranked_by, names));
  }

  SweepSummary operator()() const {
    SweepSummary summary;
    summary.trials = sweep_.trials();
    count_statuses(summary);
    summary.sample = is_sample(study_.design);
    summary.done_only = settings_.done_only;
    summary.ranked_by = settings_.ranked_by;
    for (const Metric& metric : study_.metrics) {
      summary.metrics.push_back(distribution(metric, summary.draws));
      count_misses(metric, summary);
    }
    influences(summary);
    find_worst(summary);
    return summary;
  }

 private:
  using Rows = SweepReader::Block;

  static TrialStatus status(const Rows& block, std::size_t row) { return static_cast<TrialStatus>(block.status[row]); }
  static bool done(const Rows& block, std::size_t row) { return status(block, row) == TrialStatus::done; }
  /// Whether a trial is there and not left out.
  bool is_told(const Rows& block, std::size_t row) const {
    return settings_.done_only ? done(block, row) : block.status[row] != 0.0;
  }
  /// Whether it stands for the distribution of the parameters too.
  bool counts(const Rows& block, std::size_t row) const {
    return is_told(block, row) && together_.is_draw(block.first + row);
  }
  /// An interval is for a sample alone.
  SampleEstimate told(const SampleEstimate& estimate) const {
    return is_sample(study_.design) ? estimate : estimate.without_interval();
  }

  void count_statuses(SweepSummary& summary) const {
    sweep_.for_each_block({}, [&](const Rows& block) {
      for (std::size_t row = 0; row < block.status.size(); ++row) {
        summary.done += block.status[row] == static_cast<double>(TrialStatus::done);
        summary.refused += block.status[row] == static_cast<double>(TrialStatus::refused);
        summary.halted += block.status[row] == static_cast<double>(TrialStatus::halted);
        summary.draws += counts(block, row);
      }
    });
  }

  /// Columns at trials that count; the first one is of a metric, as it is ranked.
  template <class Take>
  void for_each_part(const std::vector<std::string>& names, Take&& take) const {
    const Ranking ranking = ranking_of(study_, names.front());
    std::vector<std::vector<double>> chosen(names.size());
    sweep_.for_each_block(names, [&](const Rows& block) {
      for (std::vector<double>& column : chosen) column.clear();
      for (std::size_t row = 0; row < block.status.size(); ++row) {
        if (!counts(block, row)) continue;
        chosen[0].push_back(ranking(block.columns[0][row], done(block, row)));
        for (std::size_t k = 1; k < names.size(); ++k) chosen[k].push_back(block.columns[k][row]);
      }
      take(chosen);
    });
  }
  /// The last one of such columns.
  Column last_of(const std::vector<std::string>& names) const {
    return [this, names](const TakeValues& take) {
      for_each_part(names, [&](const auto& chosen) { take(chosen.back()); });
    };
  }

  /// draws: how many trials count.
  MetricSummary distribution(const Metric& metric, std::uint64_t draws) const {
    MetricSummary summary;
    summary.metric = metric;
    summary.least = std::numeric_limits<double>::infinity();
    summary.greatest = -summary.least;
    HeldColumn held(last_of({metric.name}), draws);
    const Column column = std::ref(held);
    Moments moments;
    std::vector<double> finite;
    column([&](std::span<const double> values) {
      finite.clear();
      for (const double value : values) {
        if (!std::isfinite(value)) continue;
        finite.push_back(value);
        summary.least = std::min(summary.least, value);
        summary.greatest = std::max(summary.greatest, value);
      }
      summary.count += finite.size();
      summary.without += values.size() - finite.size();
      moments.add(finite);
    });
    if (summary.count == 0) return summary;
    summary.mean = moments.mean;
    summary.deviation = summary.count > 1 ? moments.deviation() : 0.0;

    std::set<std::uint64_t> wanted;
    for (const double p : summary_quantiles)
      sample_quantile(quantile_ranks(draws, p), [&](std::uint64_t rank) {
        wanted.insert(rank);
        return 0.0;
      });
    const auto values = order_statistics(column, draws, wanted);
    for (const double p : summary_quantiles)
      summary.quantiles.push_back(
          told(sample_quantile(quantile_ranks(draws, p), [&](std::uint64_t rank) { return values.at(rank); })));
    return summary;
  }

  /// How often a metric misses its thresholds, or the condition of Lemma 1 fails whose margin it is.
  void count_misses(const Metric& metric, SweepSummary& summary) const {
    std::vector<ThresholdSummary> thresholds;
    for (const Threshold& threshold : study_.thresholds)
      if (threshold.metric == metric.name) {
        thresholds.emplace_back().threshold = threshold;
        thresholds.back().unit = metric.unit;
      }
    const bool is_condition = metric.condition.has_value();
    if (thresholds.empty() && !is_condition) return;
    ConditionSummary condition{is_condition ? in_words(*metric.condition) : "", 0, 0};
    std::uint64_t refused = 0, halted = 0;
    sweep_.for_each_block({metric.name}, [&](const Rows& block) {
      for (std::size_t row = 0; row < block.status.size(); ++row) {
        if (!counts(block, row)) continue;
        refused += status(block, row) == TrialStatus::refused;
        halted += status(block, row) == TrialStatus::halted;
        if (!done(block, row)) continue;
        const double value = metric.counted(block.columns.front()[row]);
        ++condition.of;
        if (!(value >= 0.0)) ++condition.trials;
        for (ThresholdSummary& t : thresholds)
          if (t.threshold.missed_by(value)) ++t.missed;
      }
    });
    for (ThresholdSummary& t : thresholds) {
      t.refused = refused;
      t.halted = halted;
      t.of = condition.of + refused + halted;
      t.share = told(probability(t.missed, t.of));
      t.not_kept = told(probability(t.of - t.kept(), t.of));
      summary.thresholds.push_back(t);
    }
    if (is_condition) summary.conditions.push_back(condition);
  }

  /// What the design is made for.
  void of_design(SweepSummary& summary) const {
    const std::size_t parameters = study_.parameters.size();
    if (const auto* const saltelli = std::get_if<Saltelli>(&study_.design))
      summary.sobol = sobol_indices(of_all_trials(settings_.ranked_by), *saltelli, parameters);
    for (const Metric& m : study_.metrics) {
      if (std::holds_alternative<Morris>(study_.design))
        summary.screenings.push_back(elementary_effects(of_all_trials(m.name), study_.design, parameters, study_.seed));
      if (std::holds_alternative<Shapley>(study_.design))
        summary.shapley.push_back(shapley_effects(of_all_trials(m.name), study_.design, parameters, study_.seed));
    }
  }

  void influences(SweepSummary& summary) const {
    const std::string& ranked_by = settings_.ranked_by;
    if (sweep_.range().first == 0) of_design(summary);
    const MorrisScreening* const screening = summary.find(summary.screenings, ranked_by);
    const ShapleyEffects* const shapley = summary.find(summary.shapley, ranked_by);
    const std::vector<SobolIndex>& sobol = summary.sobol.of;
    HeldColumn ranked(last_of({ranked_by}), summary.draws);
    const RankScale metric(std::ref(ranked), summary.draws);
    for (std::size_t k = 0; k < study_.parameters.size(); ++k) {
      const std::string& name = study_.parameters[k].name;
      HeldColumn values(last_of({ranked_by, name}), summary.draws);
      const RankScale parameter(std::ref(values), summary.draws);
      const double correlation = rank_correlation(
          [&](const TakePairs& take) {
            if (ranked.whole() && values.whole()) return take(*ranked.whole(), *values.whole());
            for_each_part({ranked_by, name}, [&](const auto& chosen) { take(chosen.front(), chosen.back()); });
          },
          metric, parameter);
      const bool varies = metric.squares() > 0.0 && parameter.squares() > 0.0;
      const SampleEstimate estimate = told(rank_correlation_estimate(correlation, summary.draws));
      Influence influence{study_.parameters[k].path, varies ? estimate : estimate.without_interval(), {}, {}, {}};
      if (!sobol.empty()) influence.sobol = sobol[k];
      if (screening && !screening->of.empty()) influence.effects = screening->of[k];
      if (shapley && !shapley->of.empty()) influence.shapley = shapley->of[k];
      summary.influences.push_back(std::move(influence));
    }
    std::stable_sort(summary.influences.begin(), summary.influences.end(),
                     [](const Influence& a, const Influence& b) { return a.size() > b.size(); });
  }
  /// A metric, not a number where a trial is missing or not done.
  Column of_all_trials(const std::string& metric) const {
    return [this, metric](const TakeValues& take) {
      sweep_.for_each_block({metric}, [&](const Rows& block) {
        std::vector<double> values = block.columns.front();
        for (std::size_t row = 0; row < values.size(); ++row)
          if (!done(block, row)) values[row] = std::numeric_limits<double>::quiet_NaN();
        take(values);
      });
    };
  }

  void find_worst(SweepSummary& summary) const {
    const Ranking ranking = ranking_of(study_, settings_.ranked_by);
    std::set<std::pair<double, std::uint64_t>> first;  // the worst first, of equals the earlier
    sweep_.for_each_block({settings_.ranked_by}, [&](const Rows& block) {
      for (std::size_t row = 0; row < block.status.size(); ++row) {
        if (!is_told(block, row)) continue;
        const double merit = -ranking.sign * ranking(block.columns.front()[row], done(block, row));
        if (first.size() == settings_.worst && (settings_.worst == 0 || merit >= first.rbegin()->first)) continue;
        first.emplace(merit, block.first + row);
        if (first.size() > settings_.worst) first.erase(std::prev(first.end()));
      }
    });
    for (const auto& [merit, trial] : first) summary.worst.push_back(sweep_.read({trial, trial + 1}).front());
  }

  const SweepReader& sweep_;
  const Study& study_;
  SummarySettings settings_;
  Block together_;
};

}  // namespace

std::string default_ranking(const Study& study) {
  if (!study.thresholds.empty()) return study.thresholds.front().metric;
  const auto with_unit = std::find_if(study.metrics.begin(), study.metrics.end(), [](const Metric& metric) {
    return metric.unit.symbol != unit::none.symbol;  // many trials count the same events: no rank tells them apart
  });
  return (with_unit != study.metrics.end() ? *with_unit : study.metrics.front()).name;
}

Ranking ranking_of(const Study& study, const std::string& name) {
  const Metric& metric = study.metric(name);
  std::size_t limits = 0, below = 0;
  for (const Threshold& threshold : study.thresholds)
    if (threshold.metric == name) {
      ++limits;
      below += threshold.above ? 0 : 1;
    }
  const bool least_is_worst = limits > 0 ? below > 0 : metric.least_is_worst;
  Ranking ranking{least_is_worst ? -1.0 : 1.0, metric.missing};
  if (std::isnan(ranking.missing)) ranking.missing = ranking.worst();
  return ranking;
}

SweepSummary summarise(const SweepReader& sweep, const SummarySettings& settings) {
  return Summariser(sweep, settings)();
}

}  // namespace wormdrive
