#include "diagnosis/verdict/learned_terms.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "description/build.hpp"
#include "description/rejection.hpp"
#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/fitting/prediction_error.hpp"
#include "diagnosis/rules/verdict.hpp"

namespace wormdrive {

namespace {

bool can_move(const Evaluation& evaluation, const Hypothesis& h) {
  Scenario scenario = evaluation.scenario();
  scenario.effects = extended(h).effects;
  return !why_it_cannot_move(scenario);
}

/// The forms of a map that promise most, each with the values of its axis.
struct PromisingForm {
  MapForm form;
  std::vector<double> sorted;
  double left_out;
};

std::vector<PromisingForm> promising_forms(const Evaluation& evaluation, const Hypothesis& h, const Magnitudes& sizes) {
  std::vector<PromisingForm> all;
  std::map<MapArgument, std::vector<double>> values;
  for (const MapForm& form : map_forms(h.drive, sizes, stated_mesh(evaluation.scenario()).i)) {
    const auto [found, is_new] = values.try_emplace(form.over);
    std::vector<double>& sorted = found->second;
    if (is_new) sorted = values_of(form.over, evaluation, h);
    if (sorted.empty()) continue;
    const auto map = chosen_by_parts(evaluation, h, form, sorted, std::span(&rules::points_of_trial_map, 1));
    if (map) all.push_back({form, sorted, map->left_out});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const PromisingForm& x, const PromisingForm& y) { return x.left_out < y.left_out; });
  if (all.size() > rules::maps_fitted) all.resize(rules::maps_fitted);
  return all;
}

/// Terms with one more, if it lowers the error ahead: the one that lowers it most.
std::optional<LearnedTerms> with_one_more(const Evaluation& evaluation, const LearnedTerms& terms,
                                          const Magnitudes& sizes) {
  std::optional<LearnedTerms> best;
  double least = (1.0 - rules::of_no_account) * terms.with;
  const auto keep_if_better = [&](LearnedTerms trial, bool is_evident) {
    trial.with = error_ahead(evaluation, trial.model, rules::reported_horizon);
    if (trial.with >= least || !can_move(evaluation, trial.model)) return;
    if (!is_evident &&
        share_of_error(evaluation, terms.model, trial.model, rules::reported_horizon) < rules::of_no_account)
      return;  // no more than by chance
    least = trial.with;
    best = std::move(trial);
  };
  for (const PromisingForm& one : promising_forms(evaluation, terms.model, sizes)) {
    auto map = chosen_by_parts(evaluation, terms.model, one.form, one.sorted, rules::points_of_map);
    if (!map) continue;
    LearnedTerms trial = terms;
    fit_map(evaluation, trial.model, *map);
    // what is left out of the fit speaks for it, though few blocks see a place where it is large
    const bool is_evident = -map->left_out > rules::left_gain;
    trial.maps.push_back(std::move(*map));
    keep_if_better(std::move(trial), is_evident);
  }
  if (!terms.vibration) {
    LearnedTerms trial = terms;
    trial.vibration = learned_vibration(evaluation, trial.model, sizes);
    if (trial.vibration) keep_if_better(std::move(trial), true);
  }
  return best;
}

}  // namespace

std::optional<LearnedTerms> learned_terms(const Evaluation& evaluation, const Hypothesis& h, const Magnitudes& sizes) {
  LearnedTerms terms{.model = h};
  terms.without = terms.with = error_ahead(evaluation, h, rules::reported_horizon);
  while (auto more = with_one_more(evaluation, terms, sizes)) terms = std::move(*more);
  if (terms.maps.empty() && !terms.vibration) return std::nullopt;
  return terms;
}

Hypothesis refined_terms(const Evaluation& evaluation, const LearnedTerms& terms, const Hypothesis& h,
                         const Magnitudes& sizes) {
  const auto with_terms = [&](Hypothesis to) {
    if (terms.vibration) add_vibration(to, *terms.vibration, sizes);
    for (const LearnedMap& map : terms.maps) put_on(to.drive, map);
    evaluate(evaluation, to);
    return to;
  };
  Hypothesis refined = with_terms(h);
  for (LearnedMap map : terms.maps) fit_map(evaluation, refined, map);
  fit(evaluation, refined, 2);
  return can_move(evaluation, refined) ? refined : with_terms(h);
}

}  // namespace wormdrive
