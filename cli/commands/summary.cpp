#include "sweep/summary/summary.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/describe/drive.hpp"
#include "cli/describe/sweep.hpp"
#include "cli/shell_words.hpp"
#include "sweep/file/so_far.hpp"
#include "sweep/summary/summary_json.hpp"

namespace wormdrive {
namespace {

void print_metrics(const SweepSummary& summary) {
  const char* const interval = summary.sample ? " [95 % interval]" : "";
  fmt::print("\n  {:<28} {:<10} {:>11} {:>11} {:>34} {:>34} {:>11}\n", "metric", "unit", "mean", "median",
             fmt::format("95 % lie below{}", interval), fmt::format("99 % lie below{}", interval), "greatest");
  bool some_without = false;
  for (const MetricSummary& m : summary.metrics) {
    if (m.count == 0) {
      fmt::print("  {:<28} {:<10} no trial has it\n", m.metric.name, m.metric.unit.symbol);
      continue;
    }
    some_without = some_without || m.without > 0;
    fmt::print("  {:<28} {:<10} {:>11.4g} {:>11.4g} {:>34} {:>34} {:>11.4g}{}\n", m.metric.name, m.metric.unit.symbol,
               m.mean, m.quantiles[1].value, with_interval(m.quantiles[2]), with_interval(m.quantiles[3]), m.greatest,
               m.without > 0 ? fmt::format("  {} without", m.without) : "");
  }
  if (some_without)
    fmt::print("  trials without a value count as the worst below a share, and not in mean and greatest\n");
}

void print_thresholds(const SweepSummary& summary) {
  const auto share = [&](const SampleEstimate& e) {
    return fmt::format("{} %{}", with_interval(e, 100.0), e.has_interval() ? " (95 % interval, exact binomial)" : "");
  };
  for (const ThresholdSummary& t : summary.thresholds) {
    print_item(t.threshold.above ? "above" : "below",
               fmt::format("{} {} {:g} {}: {} of {} trials, {}", t.threshold.metric, t.threshold.above ? ">" : "<",
                           t.threshold.limit, t.unit.symbol, t.missed, t.of, share(t.share)));
    if (t.refused + t.halted > 0)
      print_item("", fmt::format("{} refused, {} halted, {} kept; not kept in {}", t.refused, t.halted, t.kept(),
                                 share(t.not_kept)));
  }
}

void print_influences(const SweepSummary& summary) {
  fmt::print("\n  what matters most for {}\n", summary.ranked_by);
  for (const Influence& i : summary.influences)
    if (i.sobol)
      fmt::print("  {:<44} Sobol index total {:<24} first {}\n", i.parameter, with_interval(i.sobol->total),
                 with_interval(i.sobol->first));
    else
      fmt::print("  {:<44} rank correlation {:+.3f}\n", i.parameter, i.rank_correlation);
  if (const SobolIndices& sobol = summary.sobol; sobol.left_out > 0)
    fmt::print("  {} of {} samples are left out of the Sobol indices: a trial of theirs has no value\n", sobol.left_out,
               sobol.used + sobol.left_out);
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
    fmt::print("  see one: wormdrive replay {} --trial {} -o worst.h5\n", shell_path(path), ran->index);
}

void print_conditions(const SweepSummary& summary) {
  for (const ConditionSummary& c : summary.conditions)
    if (c.trials > 0) print_item("Lemma 1", fmt::format("{} of {} trials that are done: {}", c.trials, c.of, c.rule));
}

}  // namespace

int summary_command(const SummaryOptions& options) {
  const SweepSoFar so_far(options.sweep);
  const SweepReader sweep(so_far.path());
  const SweepSummary summary =
      summarise(sweep, {.ranked_by = options.metric, .worst = options.worst, .done_only = options.done_only});
  if (options.json) {
    print_json(summary_json(sweep, summary, so_far.running()));
    return 0;
  }
  fmt::print("{}\n", sweep.study().title);
  print_item("trials", fmt::format("{} of {}{}", summary.trials, sweep.range().size(),
                                   sweep.complete()   ? ""
                                   : so_far.running() ? " so far; the sweep is still running"
                                                      : " so far; the sweep was interrupted"));
  if (summary.done < summary.trials)
    print_item("failed",
               fmt::format("{} refused, {} halted; {}", summary.refused, summary.halted,
                           summary.done_only ? fmt::format("all else is told of the {} that are done", summary.done)
                                             : "they count as the worst, without them: --done-only"));
  for (const std::string& reason : sweep.reasons()) print_item("", reason);
  print_verdicts(sweep.verdicts(), sweep.study());
  print_thresholds(summary);
  print_conditions(summary);
  print_metrics(summary);
  print_influences(summary);
  print_worst(sweep, summary, options.sweep);
  return 0;
}

}  // namespace wormdrive
