#include "cli/describe/sweep.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/report/kinds.hpp"
#include "cli/report/thinning.hpp"
#include "sweep/summary/summary.hpp"
#include "sweep/summary/summary_tables.hpp"

namespace wormdrive {
namespace {

constexpr std::size_t most_metrics = 10, most_parameters = 4;  ///< that are drawn
constexpr std::size_t dots_shown = 2000;                       ///< of a cloud, and of a distribution
constexpr std::size_t bins = 25;                               ///< in which a cloud's quantiles are taken

/// A metric of the draws that are there; infinite where one without it counts as the worst.
struct Values {
  std::vector<double> values;
  std::vector<std::size_t> rows;
};
Values values_of(const ResultFile& file, const SweepReader& sweep, const std::vector<double>& status,
                 const std::string& metric) {
  const Study& study = sweep.study();
  const Ranking ranking = ranking_of(study, metric);
  const Block block = block_of(study.design, study.parameters.size());
  Values of{file.column("trials/" + metric), {}};
  for (std::size_t k = 0; k < status.size(); ++k) {
    if (status[k] == 0.0 || !block.is_draw(sweep.range().first + k)) continue;
    of.values[k] = ranking(of.values[k], status[k] == static_cast<double>(TrialStatus::done));
    of.rows.push_back(k);
  }
  return of;
}

/// What can be drawn; else a gap.
double drawable(double value) { return std::isfinite(value) ? value : NAN; }

std::string title_of(const Metric& metric) {
  return metric.condition ? in_words(*metric.condition) : words(metric.name);
}

/// "error max: largest error"
std::string described(const Metric& metric) {
  const std::string name = title_of(metric);
  return metric.meaning.empty() || metric.meaning == name ? name : fmt::format("{}: {}", name, metric.meaning);
}

/// Which value of a metric what share of the drives stays below; its tails with every drive.
ReportPanel distribution(const Values& column, const SweepSummary& summary, const MetricSummary& m) {
  std::vector<double> rising;
  for (const std::size_t row : column.rows) rising.push_back(column.values[row]);
  std::sort(rising.begin(), rising.end());
  std::vector<std::size_t> shown = even_rows(rising.size(), dots_shown);
  for (std::size_t k = 0; k < std::min<std::size_t>(200, rising.size()); ++k)
    shown.insert(shown.end(), {k, rising.size() - 1 - k});
  std::sort(shown.begin(), shown.end());
  shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
  ReportPanel panel;
  ReportSeries series{m.metric.name, std::string(m.metric.unit.symbol), described(m.metric), {}};
  for (const std::size_t k : shown) {
    panel.over.push_back((static_cast<double>(k) + 0.5) / static_cast<double>(rising.size()));
    series.values.push_back(drawable(rising[k]));
  }
  panel.series.push_back(std::move(series));
  for (const ThresholdSummary& t : summary.thresholds)
    if (t.threshold.metric == m.metric.name) panel.limits.push_back(t.threshold.limit);
  return panel;
}

/// A metric over a parameter: some trials, and what half and 95 % of all trials around stay below.
ReportPanel cloud(const Values& y, const Metric& metric, const std::vector<double>& x) {
  std::vector<std::size_t> rows = y.rows;
  std::sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) { return x[a] < x[b]; });
  const std::string units(metric.unit.symbol);
  ReportPanel panel{{},
                    {{metric.name, units, words(metric.name) + " of single drives", {}},
                     {"median", units, "half lie below", {}},
                     {"most", units, "95 % lie below", {}}},
                    ReportPanel::Style::points};
  std::vector<std::pair<double, double>> quantiles;  // of each bin
  for (std::size_t b = 0; b < bins; ++b) {
    std::vector<double> values;
    for (std::size_t k = b * rows.size() / bins; k < (b + 1) * rows.size() / bins; ++k)
      values.push_back(y.values[rows[k]]);
    std::sort(values.begin(), values.end());
    const auto at = [&](double p) {
      return values.empty()
                 ? NAN
                 : drawable(values[static_cast<std::size_t>(p * static_cast<double>(values.size() - 1) + 0.5)]);
    };
    quantiles.push_back({at(0.5), at(0.95)});
  }
  for (const std::size_t k : even_rows(rows.size(), dots_shown)) {
    panel.over.push_back(x[rows[k]]);
    panel.series[0].values.push_back(drawable(y.values[rows[k]]));
    const auto& [median, most] = quantiles[std::min(bins - 1, k * bins / rows.size())];
    panel.series[1].values.push_back(median);
    panel.series[2].values.push_back(most);
  }
  return panel;
}

ReportTable metric_table(const SweepSummary& summary) {
  const std::string interval = summary.sample ? " [interval]" : "";
  ReportTable table{"Metrics",
                    {{"metric"},
                     {"unit"},
                     {"drives", true},
                     {"without", true},
                     {"mean", true},
                     {"median", true},
                     {"95 % lie below" + interval},
                     {"99 % lie below" + interval},
                     {"greatest", true},
                     {"meaning"}},
                    {},
                    "Drives without a value count as the worst in the quantiles; mean and greatest leave them out."};
  if (summary.sample) table.note += " Intervals contain the true quantile with 95 % confidence.";
  for (const MetricSummary& m : summary.metrics)
    if (m.count > 0)
      table.rows.push_back({title_of(m.metric), std::string(m.metric.unit.symbol), static_cast<double>(m.count),
                            static_cast<double>(m.without), m.mean, m.quantiles[1].value, with_interval(m.quantiles[2]),
                            with_interval(m.quantiles[3]), m.greatest, m.metric.meaning});
  return table;
}

ReportTable influence_table(const SweepSummary& summary) {
  ReportTable table{"Influence on " + words(summary.ranked_by), {{"parameter"}, {"rank correlation", true}}, {}};
  const bool sobol = !summary.influences.empty() && summary.influences.front().sobol;
  const bool shapley = !summary.influences.empty() && summary.influences.front().shapley;
  if (shapley)
    for (const char* head : {"Shapley effect [interval]", "Sobol index, first [interval]", "total [interval]"})
      table.heads.push_back({head});
  if (sobol) table.heads.insert(table.heads.end(), {{"Sobol index, total [interval]"}, {"first [interval]"}});
  for (const Influence& i : summary.influences) {
    table.rows.push_back({i.parameter, i.rank_correlation.value});
    if (i.shapley)
      table.rows.back().insert(
          table.rows.back().end(),
          {with_interval(i.shapley->share), with_interval(i.shapley->first), with_interval(i.shapley->total)});
    if (i.sobol)
      table.rows.back().insert(table.rows.back().end(), {with_interval(i.sobol->total), with_interval(i.sobol->first)});
  }
  return table;
}

ReportTable worst_table(const SweepReader& sweep, const SweepSummary& summary) {
  const Study& study = sweep.study();
  ReportTable table{"Worst drives", {{"trial", true}, {"by " + words(summary.ranked_by)}}, {}};
  for (const UncertainParameter& p : study.parameters) table.heads.push_back({p.name, true});
  for (const Trial& trial : summary.worst) {
    table.rows.push_back({static_cast<double>(trial.index), how_it_ended(study, summary.ranked_by, trial)});
    for (const double value : trial.parameters) table.rows.back().push_back(value);
  }
  table.note = "wormdrive replay runs one of them again and writes its trajectory.";
  return table;
}

std::string verdict(const SweepSummary& summary) {
  std::string text;
  const auto share = [](const SampleEstimate& e) {
    return fmt::format(
        "{:.3g} %{}", 100.0 * e.value,
        e.has_interval() ? fmt::format("; 95 % confidence: {:.3g} to {:.3g} %", 100.0 * e.low, 100.0 * e.high) : "");
  };
  for (const ThresholdSummary& t : summary.thresholds) {
    text += fmt::format("{}{} of {} drives have {} {} {:g} {} ({}).", text.empty() ? "" : " ", t.missed, t.of,
                        words(t.threshold.metric), t.threshold.above ? "above" : "below", t.threshold.limit,
                        t.unit.symbol, share(t.share));
    if (t.refused + t.halted > 0)
      text += fmt::format(" {} more were refused and {} halted, so {} do not keep the limit ({}).", t.refused, t.halted,
                          t.of - t.kept(), share(t.not_kept));
  }
  return text;
}

}  // namespace

ReportPage report_of_sweep(const ResultFile& file) {
  const SweepReader sweep(file.path());
  const SweepSummary summary = summary_of(sweep, {.worst = worst_trials_listed});
  const Study& study = sweep.study();
  ReportPage page;
  page.summary = fmt::format("{} of {} trials{}, {} parameters; {} done, {} refused, {} halted", summary.trials,
                             sweep.range().size(), sweep.complete() ? "" : " so far", study.parameters.size(),
                             summary.done, summary.refused, summary.halted);
  page.verdict = verdict(summary);
  page.remarks = sweep.reasons();
  for (const ConditionSummary& c : summary.conditions)
    if (c.trials > 0)
      page.remarks.push_back(
          fmt::format("A condition of Lemma 1 fails in {} of {} completed trials: {}", c.trials, c.of, c.rule));

  std::vector<const MetricSummary*> drawn;
  for (const MetricSummary& m : summary.metrics)
    if (m.count > 0 && m.least < m.greatest) drawn.push_back(&m);
  std::stable_partition(drawn.begin(), drawn.end(),
                        [&](const MetricSummary* m) { return m->metric.name == summary.ranked_by; });
  if (drawn.size() > most_metrics) drawn.resize(most_metrics);
  const std::vector<double> status = file.column("trials/status");
  ReportGroup spread{"Distribution: the value that a share of the drives stays below", "share of drives", "1", {}};
  for (const MetricSummary* m : drawn)
    spread.panels.push_back(distribution(values_of(file, sweep, status, m->metric.name), summary, *m));
  if (!spread.panels.empty()) page.groups.push_back(std::move(spread));
  if (!drawn.empty() && drawn.front()->metric.name == summary.ranked_by) {
    const Values ranked = values_of(file, sweep, status, summary.ranked_by);
    for (std::size_t k = 0; k < std::min(most_parameters, summary.influences.size()); ++k) {
      const auto parameter =
          std::find_if(study.parameters.begin(), study.parameters.end(),
                       [&](const UncertainParameter& p) { return p.path == summary.influences[k].parameter; });
      page.groups.push_back({fmt::format("{} over {}", words(summary.ranked_by), parameter->name),
                             parameter->name,
                             std::string(parameter->si_unit.symbol),
                             {cloud(ranked, drawn.front()->metric, file.column("trials/" + parameter->name))}});
    }
  }
  page.tables = {metric_table(summary), influence_table(summary), worst_table(sweep, summary)};
  page.texts.push_back({"Study", study.text});
  return page;
}

}  // namespace wormdrive
