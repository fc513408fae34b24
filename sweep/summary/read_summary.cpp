#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "output/hdf5/stored_table.hpp"
#include "sweep/summary/summary_table.hpp"
#include "sweep/summary/summary_tables.hpp"

namespace wormdrive {
namespace {

/// The columns of a table of /summary, row by row.
class Stored {
 public:
  Stored(hid_t file, const SummaryTable& table) : rows_(table.rows) {
    for (std::size_t k = 0; rows_ > 0 && k < table.columns.size(); ++k)
      columns_.push_back(read_column(file, table.group() + "/" + table.columns[k].name));
  }
  std::uint64_t rows() const { return rows_; }
  double number(std::size_t column, std::size_t row) const { return columns_[column][row]; }
  std::uint64_t count(std::size_t column, std::size_t row) const {
    const double value = number(column, row);
    return value >= 0.0 && value < 0x1p53 ? static_cast<std::uint64_t>(value) : 0;
  }
  /// One that takes three columns.
  SampleEstimate estimate(std::size_t column, std::size_t row) const {
    return {number(column, row), number(column + 1, row), number(column + 2, row)};
  }

 private:
  std::uint64_t rows_;
  std::vector<std::vector<double>> columns_;
};

bool read_statuses(hid_t file, SweepSummary& summary) {
  const Stored statuses(file, status_table());
  summary.done = statuses.count(1, static_cast<std::size_t>(TrialStatus::done) - 1);
  summary.refused = statuses.count(1, static_cast<std::size_t>(TrialStatus::refused) - 1);
  summary.halted = statuses.count(1, static_cast<std::size_t>(TrialStatus::halted) - 1);
  return summary.done + summary.refused + summary.halted == summary.trials;
}

void read_metrics(hid_t file, const Study& study, SweepSummary& summary) {
  const Stored table(file, metric_table(study));
  for (std::size_t k = 0; k < study.metrics.size(); ++k) {
    MetricSummary& m = summary.metrics.emplace_back();
    m.metric = study.metrics[k];
    m.count = table.count(1, k);
    m.without = table.count(2, k);
    if (m.count == 0) {
      m.least = std::numeric_limits<double>::infinity();
      m.greatest = -m.least;
      continue;
    }
    m.mean = table.number(3, k);
    m.deviation = table.number(4, k);
    m.least = table.number(5, k);
    m.greatest = table.number(6, k);
    for (std::size_t q = 0; q < std::size(summary_quantiles); ++q) m.quantiles.push_back(table.estimate(7 + 3 * q, k));
  }
  summary.draws = summary.metrics.front().count + summary.metrics.front().without;
}

void read_thresholds(hid_t file, const Study& study, SweepSummary& summary) {
  const Stored table(file, threshold_table(study));
  std::size_t row = 0;  // they stand in the order of the metrics
  for (const Metric& metric : study.metrics)
    for (const Threshold& threshold : study.thresholds) {
      if (threshold.metric != metric.name) continue;
      summary.thresholds.push_back({threshold, metric.unit, table.count(3, row), table.count(4, row),
                                    table.count(5, row), table.count(7, row), table.estimate(8, row),
                                    table.estimate(11, row)});
      ++row;
    }
}

/// False where a correlation of zero may be that of what does not vary, which has no interval.
bool read_influences(hid_t file, const Study& study, SweepSummary& summary) {
  const SummaryTable described = influence_table(study);
  const Stored table(file, described);
  const std::vector<std::string> parameters = read_fixed_texts(file, described.group() + "/parameter");
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const double correlation = table.number(1, k);
    if (correlation == 0.0 || std::isnan(correlation)) return false;
    const SampleEstimate estimate = rank_correlation_estimate(correlation, summary.draws);
    summary.influences.push_back({parameters[k], summary.sample ? estimate : estimate.without_interval(), {}, {}, {}});
  }
  return parameters.size() == study.parameters.size();
}

bool read_worst(hid_t file, const SweepReader& sweep, unsigned most, SweepSummary& summary) {
  const Stored table(file, worst_table(sweep.study()));
  for (std::size_t k = 0; k < std::min<std::uint64_t>(most, table.rows()); ++k) {
    const double trial = table.number(1, k);
    if (trial < 0.0) break;
    const std::uint64_t index = table.count(1, k);
    if (static_cast<double>(index) != trial || !sweep.has(index)) return false;
    summary.worst.push_back(sweep.read({index, index + 1}).front());
  }
  return summary.worst.size() == std::min<std::uint64_t>(most, sweep.trials());
}

void read_conditions(hid_t file, const Study& study, SweepSummary& summary) {
  const Stored table(file, condition_table(study));
  std::size_t row = 0;
  for (const Metric& metric : study.metrics)
    if (metric.condition) {
      summary.conditions.push_back({in_words(*metric.condition), table.count(1, row), table.count(2, row)});
      ++row;
    }
}

/// Whether a design is made for more than a sample tells.
bool has_own_indices(const DesignSettings& design) {
  return std::holds_alternative<Saltelli>(design) || std::holds_alternative<Morris>(design) ||
         std::holds_alternative<Shapley>(design);
}

}  // namespace

std::optional<SweepSummary> stored_summary(const SweepReader& sweep, const SummarySettings& settings) {
  const Study& study = sweep.study();
  const std::string ranked_by = default_ranking(study);
  if (!sweep.complete() || settings.done_only || settings.worst > worst_trials_listed ||
      (!settings.ranked_by.empty() && settings.ranked_by != ranked_by) || has_own_indices(study.design))
    return std::nullopt;
  const Hdf5Handle file = open_hdf5(sweep.path());
  if (read_text_attribute(open_object(file, "summary"), "ranked_by") != ranked_by) return std::nullopt;
  SweepSummary summary;
  summary.trials = sweep.trials();
  summary.sample = is_sample(study.design);
  summary.ranked_by = ranked_by;
  if (!read_statuses(file, summary)) return std::nullopt;
  read_metrics(file, study, summary);
  read_thresholds(file, study, summary);
  read_conditions(file, study, summary);
  if (!read_influences(file, study, summary) || !read_worst(file, sweep, settings.worst, summary)) return std::nullopt;
  return summary;
}

SweepSummary summary_of(const SweepReader& sweep, const SummarySettings& settings) {
  if (auto stored = stored_summary(sweep, settings)) return std::move(*stored);
  return summarise(sweep, settings);
}

}  // namespace wormdrive
