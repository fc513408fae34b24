#include "sweep/summary/csv_tables.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "description/keys.hpp"
#include "description/number_text.hpp"
#include "sweep/study/variable.hpp"

namespace wormdrive {
namespace {

std::string text_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
  return cell + '"';
}

std::string number_cell(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

/// A number in a unit that has so much SI, as it may have been stated: 30 deg come back from radians with fewer digits.
std::string number_cell(double si, double unit) {
  const std::string short_text = fmt::format("{:.15g}", si / unit);
  return number_in(short_text).value_or(0.0) * unit == si ? short_text : number_cell(si / unit);
}

/// The rows of a summary.
class SummaryRows {
 public:
  /// table, name and metric of the rows that follow.
  void of(std::string_view table, const std::string& name, const std::string& metric) {
    begin_ = fmt::format("{},{},{}", table, text_cell(name), text_cell(metric));
  }
  void add(const std::string& quantity, const SampleEstimate& e, std::string_view unit) {
    text_ += fmt::format("{},{},{},{},{},{}\n", begin_, quantity, number_cell(e.value), number_cell(e.low),
                         number_cell(e.high), unit);
  }
  void add(const std::string& quantity, double value, std::string_view unit) {
    add(quantity, {value, std::nan(""), std::nan("")}, unit);
  }
  void add(const std::string& quantity, std::uint64_t number) { add(quantity, static_cast<double>(number), "1"); }
  std::string take() { return std::move(text_); }

 private:
  std::string begin_, text_{summary_csv_header};
};

}  // namespace

void write_trials_csv(const SweepReader& sweep, const std::function<void(std::string_view)>& put) {
  const Study& study = sweep.study();
  Scenario scenario = study.scenario;
  const std::vector<Variable> all = variables(scenario);
  std::vector<double> units;
  std::string header(trials_csv_mark.substr(0, trials_csv_mark.size() - 1));
  for (const UncertainParameter& p : study.parameters) {
    header += ',' + text_cell(p.path);
    units.push_back(std::find_if(all.begin(), all.end(), [&](const Variable& v) {
                      return v.spelling.key == p.path;
                    })->spelling.unit.si);
  }
  for (const Metric& m : study.metrics) header += ',' + spellings(m.name, m.unit, Axis::rotary).front().key;
  put(header + '\n');
  for (const TrialRange& range : sweep.present())
    for_each_trial(sweep, range, [&](const Trial& trial) {
      std::string row = fmt::format("{},{},{}", trial.index, name(trial.status), text_cell(trial.reason));
      for (std::size_t k = 0; k < units.size(); ++k) row += ',' + number_cell(trial.parameters[k], units[k]);
      for (const double value : trial.metrics) row += ',' + number_cell(value);
      put(row + '\n');
    });
}

std::string summary_csv(const SweepReader& sweep, const SweepSummary& summary) {
  SummaryRows rows;
  rows.of("trials", "", "");
  rows.add("trials", summary.trials);
  rows.add("of", sweep.range().size());
  for (const TrialStatus status : trial_statuses) rows.add(std::string(name(status)), summary.with(status));
  for (const MetricSummary& m : summary.metrics) {
    const std::string_view unit = m.metric.unit.symbol;
    rows.of("metrics", m.metric.name, m.metric.name);
    rows.add("count", m.count);
    rows.add("without", m.without);
    if (m.count == 0) continue;
    rows.add("mean", m.mean, unit);
    rows.add("deviation", m.deviation, unit);
    rows.add("least", m.least, unit);
    rows.add("greatest", m.greatest, unit);
    for (std::size_t k = 0; k < m.quantiles.size(); ++k)
      rows.add(fmt::format("quantile_{:g}", summary_quantiles[k]), m.quantiles[k], unit);
  }
  for (const ThresholdSummary& t : summary.thresholds) {
    rows.of("thresholds", fmt::format("{} {:g}", t.threshold.above ? "above" : "below", t.threshold.limit),
            t.threshold.metric);
    rows.add("limit", t.threshold.limit, t.unit.symbol);
    rows.add("missed", t.missed);
    rows.add("refused", t.refused);
    rows.add("halted", t.halted);
    rows.add("kept", t.kept());
    rows.add("of", t.of);
    rows.add("share", t.share, "1");
    rows.add("not_kept", t.not_kept, "1");
  }
  for (const Influence& i : summary.influences) {
    rows.of("influences", i.parameter, summary.ranked_by);
    rows.add("rank_correlation", i.rank_correlation, "1");
    if (!i.sobol) continue;
    rows.add("sobol_first", i.sobol->first, "1");
    rows.add("sobol_total", i.sobol->total, "1");
  }
  for (std::size_t m = 0; m < summary.screenings.size(); ++m)
    for (std::size_t k = 0; k < summary.screenings[m].of.size(); ++k) {
      const Metric& metric = summary.metrics[m].metric;
      const ElementaryEffects& effects = summary.screenings[m].of[k];
      rows.of("morris", sweep.study().parameters[k].path, metric.name);
      rows.add("mu", effects.mu, metric.unit.symbol);
      rows.add("mu_star", effects.mu_star, metric.unit.symbol);
      rows.add("sigma", effects.sigma, metric.unit.symbol);
    }
  for (std::size_t m = 0; m < summary.shapley.size(); ++m)
    for (std::size_t k = 0; k < summary.shapley[m].of.size(); ++k) {
      rows.of("shapley", sweep.study().parameters[k].path, summary.metrics[m].metric.name);
      const ShapleyEffect& effect = summary.shapley[m].of[k];
      rows.add("share", effect.share, "1");
      if (effect.first) rows.add("first", *effect.first, "1");
      if (effect.total) rows.add("total", *effect.total, "1");
    }
  for (const PairIndex& pair : summary.sobol.pairs) {
    const auto& parameters = sweep.study().parameters;
    rows.of("pairs", fmt::format("{} {}", parameters[pair.first].path, parameters[pair.second].path),
            summary.ranked_by);
    rows.add("interaction", pair.index, "1");
  }
  return rows.take();
}

}  // namespace wormdrive
