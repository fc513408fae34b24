#include "sweep/summary/summary_json.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace wormdrive {
namespace {

nlohmann::json as_json(const SampleEstimate& e) {
  if (!e.has_interval()) return {{"value", e.value}};
  return {{"value", e.value}, {"low", e.low}, {"high", e.high}};
}
nlohmann::json as_json(const ElementaryEffects& e) {
  return {{"mu", e.mu}, {"mu_star", as_json(e.mu_star)}, {"sigma", e.sigma}};
}
nlohmann::json as_json(const ShapleyEffect& e) {
  nlohmann::json json = as_json(e.share);
  if (e.first) json["first"] = as_json(*e.first);
  if (e.total) json["total"] = as_json(*e.total);
  return json;
}

/// What a design finds out of every metric and parameter, from so many of its blocks.
template <class Effects>
void add_effects(nlohmann::json& json, const char* design, const SweepSummary& summary,
                 const std::vector<Effects>& of_metrics, const char* blocks, const Study& study) {
  for (std::size_t m = 0; m < of_metrics.size(); ++m) {
    const Effects& effects = of_metrics[m];
    nlohmann::json& found = json[design][summary.metrics[m].metric.name];
    found = {{blocks, effects.used}, {"left_out", effects.left_out}};
    for (std::size_t k = 0; k < effects.of.size(); ++k)
      found["parameters"][study.parameters[k].path] = as_json(effects.of[k]);
  }
}

}  // namespace

nlohmann::json summary_json(const SweepReader& sweep, const SweepSummary& summary, bool running) {
  const Study& study = sweep.study();
  nlohmann::json json{{"title", study.title},          {"trials", summary.trials},
                      {"of", sweep.range().size()},    {"running", running},
                      {"done", summary.done},          {"refused", summary.refused},
                      {"halted", summary.halted},      {"sample", summary.sample},
                      {"draws", summary.draws},        {"done_only", summary.done_only},
                      {"ranked_by", summary.ranked_by}};
  for (const MetricSummary& m : summary.metrics) {
    nlohmann::json& metric = json["metrics"][m.metric.name];
    metric = {{"unit", m.metric.unit.symbol}, {"count", m.count}, {"without", m.without},  {"mean", m.mean},
              {"deviation", m.deviation},     {"least", m.least}, {"greatest", m.greatest}};
    if (m.metric.condition) metric["condition"] = in_words(*m.metric.condition);
    for (std::size_t k = 0; k < m.quantiles.size(); ++k)
      metric["quantiles"][fmt::format("{:g}", summary_quantiles[k])] = as_json(m.quantiles[k]);
  }
  for (const ThresholdSummary& t : summary.thresholds)
    json["thresholds"].push_back({{"metric", t.threshold.metric},
                                  {"limit", t.threshold.limit},
                                  {"above", t.threshold.above},
                                  {"missed", t.missed},
                                  {"refused", t.refused},
                                  {"halted", t.halted},
                                  {"kept", t.kept()},
                                  {"of", t.of},
                                  {"share", as_json(t.share)},
                                  {"not_kept", as_json(t.not_kept)}});
  for (const Influence& i : summary.influences) {
    nlohmann::json influence{{"parameter", i.parameter}, {"rank_correlation", i.rank_correlation.value}};
    if (const SampleEstimate& r = i.rank_correlation; r.has_interval())
      influence["rank_correlation_interval"] = {r.low, r.high};
    if (i.sobol) influence["sobol"] = {{"first", as_json(i.sobol->first)}, {"total", as_json(i.sobol->total)}};
    if (i.effects) influence["morris"] = as_json(*i.effects);
    if (i.shapley) influence["shapley"] = as_json(*i.shapley);
    json["influences"].push_back(std::move(influence));
  }
  if (!summary.sobol.of.empty())
    json["sobol"] = {{"samples", summary.sobol.used}, {"left_out", summary.sobol.left_out}};
  for (const PairIndex& pair : summary.sobol.pairs) {
    nlohmann::json found = as_json(pair.index);
    found["between"] = {study.parameters[pair.first].path, study.parameters[pair.second].path};
    json["sobol"]["pairs"].push_back(std::move(found));
  }
  add_effects(json, "shapley", summary, summary.shapley, "permutations", study);
  add_effects(json, "morris", summary, summary.screenings, "trajectories", study);
  for (const Trial& trial : summary.worst) {
    nlohmann::json worst{{"trial", trial.index}, {"status", name(trial.status)}};
    if (!trial.reason.empty()) worst["reason"] = trial.reason;
    for (std::size_t k = 0; k < study.parameters.size(); ++k)
      worst["parameters"][study.parameters[k].name] = trial.parameters[k];
    for (std::size_t k = 0; k < study.metrics.size(); ++k) worst["metrics"][study.metrics[k].name] = trial.metrics[k];
    json["worst"].push_back(std::move(worst));
  }
  for (const ConditionSummary& c : summary.conditions)
    if (c.trials > 0) json["lemma1"].push_back({{"condition", c.rule}, {"trials", c.trials}, {"of", c.of}});
  return json;
}

}  // namespace wormdrive
