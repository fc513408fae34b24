#include "sweep/summary/summary_tables.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "output/hdf5/fixed_table.hpp"
#include "output/hdf5/stored_table.hpp"

namespace wormdrive {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A table of the summary: its columns, texts beside them, and rows as they are filled.
struct SummaryTable {
  std::string name;
  std::uint64_t rows;
  std::vector<ColumnDescription> columns;
  std::vector<std::pair<std::string, std::string>> texts;  ///< name, long name

  std::string group() const { return "summary/" + name; }
};

/// An estimate takes three columns.
void add_estimate(SummaryTable& table, const std::string& name, const std::string& units, const std::string& meaning) {
  table.columns.push_back({name, units, meaning});
  table.columns.push_back({name + "_low", units, "lower end of its 95 % interval; not a number if it has none"});
  table.columns.push_back({name + "_high", units, "upper end of its 95 % interval"});
}
void append(std::vector<double>& row, const SampleEstimate& e) { row.insert(row.end(), {e.value, e.low, e.high}); }

std::uint64_t conditions_of(const Study& study) {
  return static_cast<std::uint64_t>(std::count_if(study.metrics.begin(), study.metrics.end(),
                                                  [](const Metric& m) { return m.condition.has_value(); }));
}

SummaryTable status_table() {
  return {"statuses",
          std::size(trial_statuses),
          {{"status", "1", "how trials ended, as in /trials"}, {"trials", "1", "how many"}},
          {}};
}

SummaryTable metric_table(const Study& study) {
  SummaryTable table{"metrics",
                     study.metrics.size(),
                     {{"index", "1", "number of the metric"},
                      {"count", "1", "trials that have a finite value"},
                      {"without", "1", "trials without: refused, halted, or it never happened"},
                      {"mean", "", "mean of the finite values, in the unit of the metric"},
                      {"deviation", "", "standard deviation"},
                      {"least", "", "least value"},
                      {"greatest", "", "greatest value"}},
                     {{"name", "name of the metric"}, {"unit", "its unit"}}};
  for (const double p : summary_quantiles)
    add_estimate(table, fmt::format("quantile_{:.0f}", 100.0 * p), "",
                 fmt::format("{:.0f} % of the trials lie below, those without a value as the worst", 100.0 * p));
  return table;
}

SummaryTable threshold_table(const Study& study) {
  SummaryTable table{"thresholds",
                     study.thresholds.size(),
                     {{"index", "1", "number of the threshold"},
                      {"limit", "", "limit, in the unit of the metric"},
                      {"above", "1", "1: missed above the limit, 0: below"},
                      {"missed", "1", "trials that are done and miss it"},
                      {"refused", "1", "trials whose values make no drive that could run"},
                      {"halted", "1", "trials whose simulation could not go on"},
                      {"kept", "1", "trials that keep it"},
                      {"of", "1", "all of them"}},
                     {{"metric", "metric that it limits"}}};
  add_estimate(table, "share", "1", "share that misses it; exact binomial interval");
  add_estimate(table, "not_kept", "1", "share that misses it, was refused or halted; exact binomial interval");
  return table;
}

SummaryTable influence_table(const Study& study) {
  SummaryTable table{"influences",
                     study.parameters.size(),
                     {{"index", "1", "number of the parameter"},
                      {"rank_correlation", "1", "Spearman's, with the metric by which trials are ranked"}},
                     {{"parameter", "path of the parameter"}}};
  add_estimate(table, "first", "1", "first Sobol index; not a number unless the design is saltelli");
  add_estimate(table, "total", "1", "total Sobol index");
  return table;
}

SummaryTable worst_table(const Study& study) {
  SummaryTable table{"worst",
                     std::min<std::uint64_t>(worst_trials_listed, study.trials()),
                     {{"index", "1", "rank, 0 for the worst"},
                      {"trial", "1", "index of the trial, -1 for none"},
                      {"status", "1", "how it ended, as in /trials"},
                      {"value", "", "its value of the metric by which trials are ranked; not a number if it has none"}},
                     {}};
  for (const UncertainParameter& p : study.parameters)
    table.columns.push_back({p.name, std::string(p.si_unit.symbol), "parameter " + p.path});
  return table;
}

SummaryTable condition_table(const Study& study) {
  return {"conditions",
          conditions_of(study),
          {{"index", "1", "number of the condition of Lemma 1, counted from 0"},
           {"failed", "1", "trials for whose values it does not hold"},
           {"of", "1", "trials that are done"}},
          {{"rule", "the condition in words"}}};
}

SummaryTable screening_table(const Study& study) {
  const bool screens = std::holds_alternative<Morris>(study.design);
  SummaryTable table{"morris",
                     screens ? study.metrics.size() * study.parameters.size() : 0,
                     {{"index", "1", "number of the row"}, {"mu", "", "mean of the elementary effects"}},
                     {{"metric", "name of the metric"}, {"parameter", "path of the parameter"}}};
  add_estimate(table, "mu_star", "", "mean of the absolute elementary effects, in the unit of the metric");
  table.columns.push_back({"sigma", "", "standard deviation of the elementary effects"});
  return table;
}

/// Those that a study has.
std::vector<SummaryTable> summary_tables(const Study& study) {
  std::vector<SummaryTable> tables{status_table(),         metric_table(study), threshold_table(study),
                                   influence_table(study), worst_table(study),  condition_table(study),
                                   screening_table(study)};
  std::erase_if(tables, [](const SummaryTable& table) { return table.rows == 0; });
  return tables;
}

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
  const auto ranked = std::find_if(study.metrics.begin(), study.metrics.end(),
                                   [&](const Metric& m) { return m.name == summary.ranked_by; });
  for (std::uint64_t k = 0; k < table.rows; ++k) {
    std::vector<double> row{rows.next(), -1.0};
    if (k < summary.worst.size()) {
      const Trial& trial = summary.worst[k];
      row = {rows.next(), static_cast<double>(trial.index), static_cast<double>(trial.status),
             trial.metrics[static_cast<std::size_t>(ranked - study.metrics.begin())]};
      row.insert(row.end(), trial.parameters.begin(), trial.parameters.end());
    }
    row.resize(table.columns.size(), none);
    rows.add(row);
  }
}

void write_conditions(hid_t file, const SweepSummary& summary, const Study& study) {
  if (conditions_of(study) == 0) return;
  Rows rows(file, condition_table(study));
  for (const ConditionSummary& c : summary.conditions)
    rows.add({rows.next(), static_cast<double>(c.trials), static_cast<double>(c.of)}, {c.rule});
}

void write_screenings(hid_t file, const SweepSummary& summary, const Study& study) {
  const SummaryTable table = screening_table(study);
  if (table.rows == 0) return;
  Rows rows(file, table);
  for (std::size_t m = 0; m < study.metrics.size(); ++m)
    for (std::size_t k = 0; k < study.parameters.size(); ++k) {
      std::vector<double> row{rows.next()};
      if (m < summary.screenings.size() && !summary.screenings[m].of.empty()) {
        const ElementaryEffects& effects = summary.screenings[m].of[k];
        row.push_back(effects.mu);
        append(row, effects.mu_star);
        row.push_back(effects.sigma);
      }
      row.resize(table.columns.size(), none);
      rows.add(row, {study.metrics[m].name, study.parameters[k].path});
    }
}

}  // namespace

void create_summary_tables(hid_t file, const Study& study) {
  const Hdf5Handle summary = create_group(file, "summary");
  write_attribute(summary, "ranked_by", default_ranking(study));
  for (const SummaryTable& table : summary_tables(study)) {
    FixedTable::create(file, table.group(), table.columns, table.rows);
    for (const auto& [name, long_name] : table.texts)
      FixedTexts::create(file, table.group() + "/" + name, long_name, table.rows);
  }
}

void check_summary_tables(hid_t file, const Study& study) {
  read_text_attribute(open_object(file, "summary"), "ranked_by");
  for (const SummaryTable& table : summary_tables(study)) {
    const StoredTable stored(file, table.group());
    for (const ColumnDescription& column : table.columns) stored.check(column, Range::any);
    for (const auto& [name, long_name] : table.texts) check_fixed_texts(stored.column(name), table.rows);
    if (stored.rows() != table.rows)
      stored.column(table.columns.front().name)
          .reject(fmt::format("has {} rows instead of {}", stored.rows(), table.rows));
  }
}

void write_summary_tables(hid_t file, const SweepSummary& summary, const Study& study) {
  Rows statuses(file, status_table());
  for (const TrialStatus status : trial_statuses)
    statuses.add({static_cast<double>(status), static_cast<double>(summary.with(status))});
  write_metrics(file, summary, study);
  write_thresholds(file, summary, study);
  write_influences(file, summary, study);
  write_worst(file, summary, study);
  write_conditions(file, summary, study);
  write_screenings(file, summary, study);
}

}  // namespace wormdrive
