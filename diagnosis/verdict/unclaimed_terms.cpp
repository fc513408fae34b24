#include "diagnosis/verdict/unclaimed_terms.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "diagnosis/fitting/prediction_error.hpp"
#include "diagnosis/rules/verdict.hpp"
#include "diagnosis/verdict/verdict.hpp"

namespace wormdrive {

std::optional<Selection> better_alone(const Evaluation& evaluation, const Selection& selection,
                                      const std::vector<Candidate>& all) {
  std::vector<const Tried*> eligible;
  double bic = std::numeric_limits<double>::infinity();
  for (const Tried& one : selection.tried)
    if (!all[one.candidate].of_recording && accepted(one.evidence, all[one.candidate])) {
      eligible.push_back(&one);
      bic = std::min(bic, one.model.bic);
    }
  const double enough = bic + equivalence_margin(selection.base.bic - bic);
  double least = error_ahead(evaluation, selection.model, rules::reported_horizon);
  const Tried* best = nullptr;
  for (const Tried* one : eligible) {
    if (one->model.bic > enough) continue;
    if (const double error = error_ahead(evaluation, one->model, rules::reported_horizon); error < least) {
      least = error;
      best = one;
    }
  }
  if (!best) return std::nullopt;
  Selection alone = selection;
  alone.model = best->model;
  alone.causes = {{best->candidate, {}}};
  return alone;
}

bool unclaimed_terms_predict(const Diagnosis& d, const Evaluation& evaluation, const Selection& selection,
                             const std::vector<Candidate>& all, const std::optional<LearnedTerms>& learned) {
  if (std::any_of(selection.causes.begin(), selection.causes.end(),
                  [&](const Found& found) { return all[found.candidate].of_recording; }))
    return false;  // an extended scenario holds no fault of a recording
  const PredictionError* e = reported_error(d);
  const double without = learned ? learned->with : error_ahead(evaluation, selection.base, rules::reported_horizon);
  return e && e->after < (1.0 - rules::of_no_account) * std::min(e->before, without);
}

std::string unclaimed_terms_sentence(const Diagnosis& d, const Selection& selection,
                                     const std::vector<Candidate>& all) {
  std::vector<std::string> effects;
  for (const Found& found : selection.causes) effects.push_back(in_words(std::string(all[found.candidate].effect)));
  return fmt::format(" The extended scenario holds {}, which claim{} no cause.", joined(effects, "and"),
                     effects.size() == 1 ? "s" : "") +
         gain_sentence(d);
}

}  // namespace wormdrive
