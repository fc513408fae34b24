#include "sweep/summary/summary.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/describe/drive.hpp"
#include "cli/describe/sweep.hpp"
#include "cli/shell_words.hpp"
#include "sweep/file/so_far.hpp"
#include "sweep/summary/summary_json.hpp"

namespace wormdrive {
namespace {

struct SummaryOptions {
  std::string sweep;
  std::string metric;  ///< by which trials are ranked; empty: that of the first threshold, else the first with a unit
  unsigned worst = 5;  ///< trials shown
  bool done_only = false;  ///< leave out refused and halted trials
  bool json = false;
};

using Chosen = std::vector<const MetricSummary*>;

/// The margins of Lemma 1's conditions, or all other metrics.
Chosen choose(const SweepSummary& summary, bool conditions) {
  Chosen list;
  for (const MetricSummary& m : summary.metrics)
    if (m.metric.condition.has_value() == conditions) list.push_back(&m);
  return list;
}

/// What all trials share, on one line: "0 for layer_violations, reversals; 0.2 s for layer_reached".
void print_constants(const std::string& heading, const Chosen& metrics) {
  std::vector<std::pair<std::string, std::string>> values;
  for (const MetricSummary* m : metrics) {
    if (!m->is_constant()) continue;
    const std::string value = m->least == 0.0 ? "0" : fmt::format("{:.4g}{}", m->least, in_unit(m->metric.unit)),
                      name = m->metric.condition ? m->metric.condition->rule : m->metric.name;
    const auto same = std::find_if(values.begin(), values.end(), [&](const auto& v) { return v.first == value; });
    if (same != values.end())
      same->second += ", " + name;
    else
      values.emplace_back(value, name);
  }
  std::string text;
  for (const auto& [value, names] : values) text += fmt::format("{}{} for {}", text.empty() ? "" : "; ", value, names);
  if (!text.empty()) fmt::print("  {}: {}\n", heading, text);
}

void print_metrics(const SweepSummary& summary) {
  const Chosen metrics = choose(summary, false);
  const char* const interval = summary.sample ? " [95 % interval]" : "";
  fmt::print("\n  {:<28} {:<10} {:>11} {:>11} {:>34} {:>34} {:>11}\n", "metric", "unit", "mean", "median",
             fmt::format("95 % lie below{}", interval), fmt::format("99 % lie below{}", interval), "greatest");
  bool some_without = false;
  for (const MetricSummary* m : metrics) {
    if (m->is_constant()) continue;
    if (m->count == 0) {
      fmt::print("  {:<28} {:<10} no trial has a value\n", m->metric.name, m->metric.unit.symbol);
      continue;
    }
    some_without = some_without || m->without > 0;
    fmt::print("  {:<28} {:<10} {:>11.4g} {:>11.4g} {:>34} {:>34} {:>11.4g}{}\n", m->metric.name, m->metric.unit.symbol,
               m->mean, m->quantiles[1].value, with_interval(m->quantiles[2]), with_interval(m->quantiles[3]),
               m->greatest, m->without > 0 ? fmt::format("  {} without a value", m->without) : "");
  }
  if (some_without)
    fmt::print("  trials without a value count as the worst in the quantiles; mean and greatest leave them out\n");
  print_constants("the same in all trials", metrics);
}

void print_conditions(const SweepSummary& summary) {
  const Chosen margins = choose(summary, true);
  if (margins.empty()) return;
  fmt::print("\n  Lemma 1: margin of each condition, negative if it fails\n");
  fmt::print("  {:>11} {:>11} {:>16}   {}\n", "least", "mean", "fails in", "condition (name of the metric)");
  for (std::size_t k = 0; k < margins.size(); ++k) {
    const MetricSummary& m = *margins[k];
    const ConditionSummary& c = summary.conditions[k];
    if (m.count == 0 || (m.is_constant() && c.trials == 0)) continue;
    fmt::print("  {:>11.4g} {:>11.4g} {:>16}   {} ({})\n", m.least, m.mean, fmt::format("{} of {}", c.trials, c.of),
               c.rule, m.metric.name);
  }
  Chosen holding;
  for (std::size_t k = 0; k < margins.size(); ++k)
    if (summary.conditions[k].trials == 0) holding.push_back(margins[k]);
  print_constants("the same margin in all trials", holding);
}

/// The limits that the study states, in its order.
void print_thresholds(const SweepSummary& summary, const Study& study) {
  const auto share = [&](const SampleEstimate& e) {
    return fmt::format("{} %{}", with_interval(e, 100.0), e.has_interval() ? " (95 % interval, exact binomial)" : "");
  };
  for (const Threshold& stated : study.thresholds) {
    const auto t =
        std::find_if(summary.thresholds.begin(), summary.thresholds.end(), [&](const ThresholdSummary& found) {
          return found.threshold.metric == stated.metric && found.threshold.limit == stated.limit &&
                 found.threshold.above == stated.above;
        });
    print_item("limit", fmt::format("{} at {} {:g}{}: missed in {} of {} trials, {}", stated.metric,
                                    stated.above ? "most" : "least", stated.limit, in_unit(t->unit), t->missed, t->of,
                                    share(t->share)));
    if (t->refused + t->halted > 0)
      print_item("", fmt::format("{} refused, {} halted, {} kept; missed, refused or halted: {}", t->refused, t->halted,
                                 t->kept(), share(t->not_kept)));
  }
}

/// What several parameters do together: the largest of the second-order indices.
void print_pairs(const SweepSummary& summary, const Study& study) {
  constexpr std::size_t most = 5;
  std::vector<PairIndex> pairs = summary.sobol.pairs;
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const PairIndex& a, const PairIndex& b) { return a.index.value > b.index.value; });
  for (std::size_t k = 0; k < std::min(most, pairs.size()); ++k)
    fmt::print("  {:<44} {} {}\n", k == 0 ? "interactions, the largest first" : "", with_interval(pairs[k].index),
               study.parameters[pairs[k].first].path + " with " + study.parameters[pairs[k].second].path);
}

/// How many of the blocks of a design are not evaluated.
template <class Effects>
void print_left_out(std::string_view blocks, const Effects* found, std::string_view indices, bool complete) {
  if (found && found->left_out > 0)
    fmt::print("  {} of {} {} are left out{} because one of their trials has {}no value\n", found->left_out,
               found->used + found->left_out, blocks, indices, complete ? "" : "not run or has ");
}

void print_influences(const SweepSummary& summary, bool complete) {
  fmt::print("\n  influence on {}, the largest first\n", summary.ranked_by);
  const auto ranked = std::find_if(summary.metrics.begin(), summary.metrics.end(),
                                   [&](const MetricSummary& m) { return m.metric.name == summary.ranked_by; });
  for (const Influence& i : summary.influences)
    if (i.sobol)
      fmt::print("  {:<44} Sobol index total {:<24} first {}\n", i.parameter, with_interval(i.sobol->total),
                 with_interval(i.sobol->first));
    else if (i.shapley)
      fmt::print("  {:<44} Shapley effect {:<29} first {:<29} total {}\n", i.parameter, with_interval(i.shapley->share),
                 with_interval(i.shapley->first), with_interval(i.shapley->total));
    else if (i.effects)
      fmt::print("  {:<44} mu* {:<30} mu {:<12.4g} sigma {:.4g}{}\n", i.parameter, with_interval(i.effects->mu_star),
                 i.effects->mu, i.effects->sigma, in_unit(ranked->metric.unit));
    else
      fmt::print("  {:<44} rank correlation {:+.3f}{}\n", i.parameter, i.rank_correlation.value,
                 i.rank_correlation.has_interval()
                     ? fmt::format(" [{:+.3f}, {:+.3f}]", i.rank_correlation.low, i.rank_correlation.high)
                     : "");
  print_left_out("samples", &summary.sobol, " of the Sobol indices", complete);
  print_left_out("trajectories", summary.find(summary.screenings, summary.ranked_by), "", complete);
  print_left_out("permutations", summary.find(summary.shapley, summary.ranked_by), "", complete);
}

void print_worst(const SweepReader& sweep, const SweepSummary& summary, const std::string& path) {
  if (summary.worst.empty()) return;
  fmt::print("\n  worst trials\n");
  const Study& study = sweep.study();
  for (const Trial& trial : summary.worst) {
    std::string values = how_it_ended(study, summary.ranked_by, trial);
    for (std::size_t k = 0; k < study.parameters.size(); ++k)
      values += fmt::format(", {} {:.6g}{}", study.parameters[k].name, trial.parameters[k],
                            in_unit(study.parameters[k].si_unit));
    fmt::print("  trial {:<9} {}\n", trial.index, values);
  }
  const auto ran = std::find_if(summary.worst.begin(), summary.worst.end(),
                                [](const Trial& trial) { return trial.status != TrialStatus::refused; });
  if (ran != summary.worst.end())
    fmt::print("  see a trial: wormdrive replay {} --trial {} -o worst.h5\n", shell_path(path), ran->index);
}

int summary_command(const SummaryOptions& options) {
  const SweepSoFar so_far(options.sweep);
  const SweepReader sweep(so_far.path());
  const SweepSummary summary =
      summary_of(sweep, {.ranked_by = options.metric, .worst = options.worst, .done_only = options.done_only});
  if (options.json) {
    print_json(summary_json(sweep, summary, so_far.running()));
    return 0;
  }
  fmt::print("{}\n", sweep.study().title);
  print_thresholds(summary, sweep.study());
  print_item("trials", fmt::format("{} of {}{}", summary.trials, sweep.range().size(),
                                   sweep.complete()   ? ""
                                   : so_far.running() ? " so far; the sweep is still running"
                                                      : " so far; the sweep was interrupted"));
  if (summary.done < summary.trials)
    print_item("failed", fmt::format("{} refused, {} halted; {}", summary.refused, summary.halted,
                                     summary.done_only
                                         ? fmt::format("all other lines describe the {} completed trials", summary.done)
                                         : "they count as the worst (--done-only leaves them out)"));
  for (const std::string& reason : sweep.reasons()) print_item("", reason);
  if (const Block block = block_of(sweep.study().design, sweep.study().parameters.size()); block.draws < block.trials)
    print_item("draws", fmt::format("{} of these trials, of which limits and metrics tell; the others differ from one "
                                    "of them by some parameters alone",
                                    summary.draws));
  print_metrics(summary);
  print_conditions(summary);
  print_influences(summary, sweep.complete());
  print_pairs(summary, sweep.study());
  print_worst(sweep, summary, options.sweep);
  if (!sweep.verdicts().empty()) fmt::print("\n");
  print_verdicts(sweep.verdicts(), sweep.study());
  return 0;
}

}  // namespace

void add_summary(CommandSet& commands) {
  auto [command, options] =
      commands.add("summary", "print what a sweep shows: limits missed, quantiles, influences", summary_command);
  command.add_option("sweep", options.sweep, "result of a sweep (.h5)")->required();
  command.add_option("--metric", options.metric,
                     "metric that ranks parameters and trials; default: that of the first threshold, or the first one "
                     "with a unit");
  command.add_option("--worst", options.worst, "number of worst trials to list")->capture_default_str();
  command.add_flag("--done-only", options.done_only,
                   "leave out refused and halted trials, which otherwise count as the worst");
  add_json(command, options.json);
}

}  // namespace wormdrive
