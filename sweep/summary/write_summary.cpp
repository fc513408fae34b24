#include <limits>

#include "sweep/summary/summary_table.hpp"
#include "sweep/summary/summary_tables.hpp"

namespace wormdrive {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

void append(std::vector<double>& row, const SampleEstimate& e) { row.insert(row.end(), {e.value, e.low, e.high}); }

/// Writes rows that are given one after the other.
class Rows {
 public:
  Rows(hid_t file, const SummaryTable& table) : table_(file, table.group(), table.columns) {
    for (const auto& text : table.texts) texts_.emplace_back(file, table.group() + "/" + text.first);
  }
  void add(const std::vector<double>& values, const std::vector<std::string>& texts = {}) {
    for (std::size_t k = 0; k < values.size(); ++k) table_.write(k, row_, {values[k]});
    for (std::size_t k = 0; k < texts.size(); ++k) texts_[k].write(row_, texts[k]);
    ++row_;
  }
  double next() const { return static_cast<double>(row_); }

 private:
  FixedTable table_;
  std::vector<FixedTexts> texts_;
  std::uint64_t row_ = 0;
};

void write_metrics(hid_t file, const SweepSummary& summary, const Study& study) {
  Rows rows(file, metric_table(study));
  for (const MetricSummary& m : summary.metrics) {
    std::vector<double> row{rows.next(), static_cast<double>(m.count), static_cast<double>(m.without)};
    if (m.count == 0) {
      row.resize(metric_table(study).columns.size(), none);
    } else {
      row.insert(row.end(), {m.mean, m.deviation, m.least, m.greatest});
      for (const SampleEstimate& quantile : m.quantiles) append(row, quantile);
    }
    rows.add(row, {m.metric.name, std::string(m.metric.unit.symbol)});
  }
}

void write_thresholds(hid_t file, const SweepSummary& summary, const Study& study) {
  if (study.thresholds.empty()) return;
  Rows rows(file, threshold_table(study));
  for (const ThresholdSummary& t : summary.thresholds) {
    std::vector<double> row{rows.next(),
                            t.threshold.limit,
                            t.threshold.above ? 1.0 : 0.0,
                            static_cast<double>(t.missed),
                            static_cast<double>(t.refused),
                            static_cast<double>(t.halted),
                            static_cast<double>(t.kept()),
                            static_cast<double>(t.of)};
    append(row, t.share);
    append(row, t.not_kept);
    rows.add(row, {t.threshold.metric});
  }
}

void write_influences(hid_t file, const SweepSummary& summary, const Study& study) {
  Rows rows(file, influence_table(study));
  for (const Influence& i : summary.influences) {
    std::vector<double> row{rows.next(), i.rank_correlation.value};
    const SampleEstimate unknown{none, none, none};
    append(row, i.sobol ? i.sobol->first : unknown);
    append(row, i.sobol ? i.sobol->total : unknown);
    rows.add(row, {i.parameter});
  }
}

void write_worst(hid_t file, const SweepSummary& summary, const Study& study) {
  const SummaryTable table = worst_table(study);
  Rows rows(file, table);
  const std::size_t ranked = study.place_of(summary.ranked_by);
  for (std::uint64_t k = 0; k < table.rows; ++k) {
    std::vector<double> row{rows.next(), -1.0};
    if (k < summary.worst.size()) {
      const Trial& trial = summary.worst[k];
      row = {rows.next(), static_cast<double>(trial.index), static_cast<double>(trial.status), trial.metrics[ranked]};
      row.insert(row.end(), trial.parameters.begin(), trial.parameters.end());
    }
    row.resize(table.columns.size(), none);
    rows.add(row);
  }
}

void write_conditions(hid_t file, const SweepSummary& summary, const Study& study) {
  if (condition_table(study).rows == 0) return;
  Rows rows(file, condition_table(study));
  for (const ConditionSummary& c : summary.conditions)
    rows.add({rows.next(), static_cast<double>(c.trials), static_cast<double>(c.of)}, {c.rule});
}

/// Rows of a table with one for each metric and parameter: fill(metric, parameter, row) where there is something.
template <class PerMetric, class Fill>
void write_effects(hid_t file, const SummaryTable& table, const std::vector<PerMetric>& found, const Study& study,
                   Fill&& fill) {
  if (table.rows == 0) return;
  Rows rows(file, table);
  for (std::size_t m = 0; m < study.metrics.size(); ++m)
    for (std::size_t k = 0; k < study.parameters.size(); ++k) {
      std::vector<double> row{rows.next()};
      if (m < found.size() && !found[m].of.empty()) fill(found[m].of[k], row);
      row.resize(table.columns.size(), none);
      rows.add(row, {study.metrics[m].name, study.parameters[k].path});
    }
}

void write_pairs(hid_t file, const SweepSummary& summary, const Study& study) {
  const SummaryTable table = pair_table(study);
  if (table.rows == 0) return;
  Rows rows(file, table);
  std::size_t n = 0;
  for (std::size_t k = 0; k < study.parameters.size(); ++k)
    for (std::size_t j = 0; j < k; ++j, ++n) {
      std::vector<double> row{rows.next()};
      if (n < summary.sobol.pairs.size()) append(row, summary.sobol.pairs[n].index);
      row.resize(table.columns.size(), none);
      rows.add(row, {study.parameters[j].path, study.parameters[k].path});
    }
}

}  // namespace

void write_summary_tables(hid_t file, const SweepSummary& summary, const Study& study) {
  Rows statuses(file, status_table());
  for (const TrialStatus status : trial_statuses)
    statuses.add({static_cast<double>(status), static_cast<double>(summary.with(status))});
  write_metrics(file, summary, study);
  write_thresholds(file, summary, study);
  write_influences(file, summary, study);
  write_worst(file, summary, study);
  write_conditions(file, summary, study);
  write_effects(file, screening_table(study), summary.screenings, study,
                [](const ElementaryEffects& effects, std::vector<double>& row) {
                  row.push_back(effects.mu);
                  append(row, effects.mu_star);
                  row.push_back(effects.sigma);
                });
  write_effects(file, shapley_table(study), summary.shapley, study,
                [](const ShapleyEffect& effect, std::vector<double>& row) {
                  append(row, effect.share);
                  for (const auto& index : {effect.first, effect.total})
                    append(row, index.value_or(SampleEstimate{none, none, none}));
                });
  write_pairs(file, summary, study);
}

}  // namespace wormdrive
