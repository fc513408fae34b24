#include "sweep/summary/summary_tables.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "output/hdf5/stored_table.hpp"
#include "sweep/summary/summary_table.hpp"

namespace wormdrive {
namespace {

/// An estimate takes three columns.
void add_estimate(SummaryTable& table, const std::string& name, const std::string& units, const std::string& meaning) {
  table.columns.push_back({name, units, meaning});
  table.columns.push_back({name + "_low", units, "lower end of its 95 % interval; not a number if it has none"});
  table.columns.push_back({name + "_high", units, "upper end of its 95 % interval"});
}
std::uint64_t conditions_of(const Study& study) {
  return static_cast<std::uint64_t>(std::count_if(study.metrics.begin(), study.metrics.end(),
                                                  [](const Metric& m) { return m.condition.has_value(); }));
}

/// The rows of a table with one for each metric and parameter.
std::uint64_t effects_of(const Study& study) { return study.metrics.size() * study.parameters.size(); }

}  // namespace

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
                     screens ? effects_of(study) : 0,
                     {{"index", "1", "number of the row"}, {"mu", "", "mean of the elementary effects"}},
                     {{"metric", "name of the metric"}, {"parameter", "path of the parameter"}}};
  add_estimate(table, "mu_star", "", "mean of the absolute elementary effects, in the unit of the metric");
  table.columns.push_back({"sigma", "", "standard deviation of the elementary effects"});
  return table;
}

SummaryTable shapley_table(const Study& study) {
  SummaryTable table{"shapley",
                     std::holds_alternative<Shapley>(study.design) ? effects_of(study) : 0,
                     {{"index", "1", "number of the row"}},
                     {{"metric", "name of the metric"}, {"parameter", "path of the parameter"}}};
  add_estimate(table, "share", "1", "Shapley effect: share of the variance of the metric");
  add_estimate(table, "first", "1", "first-order Sobol index, with what the parameter tells of the others");
  add_estimate(table, "total", "1", "total Sobol index: what remains where all others are known");
  return table;
}

SummaryTable pair_table(const Study& study) {
  const auto* const saltelli = std::get_if<Saltelli>(&study.design);
  const std::uint64_t parameters = study.parameters.size();
  SummaryTable table{"pairs",
                     saltelli && saltelli->second_order ? parameters * (parameters - 1) / 2 : 0,
                     {{"index", "1", "number of the row"}},
                     {{"first", "path of a parameter"}, {"second", "path of another one"}}};
  add_estimate(table, "interaction", "1", "second-order Sobol index");
  return table;
}

namespace {

/// Those that a study has.
std::vector<SummaryTable> summary_tables(const Study& study) {
  std::vector<SummaryTable> tables{status_table(),         metric_table(study),  threshold_table(study),
                                   influence_table(study), worst_table(study),   condition_table(study),
                                   screening_table(study), shapley_table(study), pair_table(study)};
  std::erase_if(tables, [](const SummaryTable& table) { return table.rows == 0; });
  return tables;
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

}  // namespace wormdrive
