#include "diagnosis/inference/alone.hpp"

#include <algorithm>

#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "statistics/parallel.hpp"

namespace wormdrive {

namespace {

/// From its starts, and from far values that do better than the base as they are.
Hypothesis best_fit(const Evaluation& evaluation, const std::vector<Candidate>& all, std::size_t candidate,
                    const Hypothesis& base) {
  std::vector<Hypothesis> trials(all[candidate].starts.size() + all[candidate].far.size(), base);
  parallel_for(trials.size(), evaluation.threads(), [&](std::size_t start) {
    add_candidate(trials[start], all, candidate, start);
    evaluate(evaluation, trials[start]);
    if (start < all[candidate].starts.size() || trials[start].objective < base.objective)
      fit(evaluation, trials[start], 6);
  });
  Hypothesis best = *std::min_element(trials.begin(), trials.end(),
                                      [](const Hypothesis& x, const Hypothesis& y) { return x.bic < y.bic; });
  // far from what is stated noise and model are found by turns
  for (int turn = 0; turn < rules::turns_alone && base.bic - best.bic > rules::least_bic; ++turn) {
    restart_noise(evaluation, best);
    adjust_noise(evaluation, best, 3);
    fit(evaluation, best, 4);
  }
  return best;
}

}  // namespace

void try_alone(const Evaluation& evaluation, const std::vector<Candidate>& all, Selection& found) {
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (!all[c].alone) continue;
    Hypothesis with = best_fit(evaluation, all, c, found.base);
    Hypothesis without = found.base;
    if (found.base.bic - with.bic > rules::least_bic) {  // a better mixture of noise is no merit of it
      without.noise = with.noise;
      fit(evaluation, without, 5);
    }
    const Evidence evidence =
        compare(without.objective < found.base.objective ? without : found.base, with, all[c], evaluation.layout());
    found.tried.push_back({c, with, evidence});
    // one that explains as much as several is the better explanation
    const double several = found.causes.size() > 1 ? equivalence_margin(found.base.bic - found.model.bic) : 0.0;
    if (!accepted(evidence, all[c]) || with.bic >= found.model.bic + several) continue;
    found.model = std::move(with);
    found.causes = {{c, {}}};
    found.beyond_bound.reset();
  }
}

}  // namespace wormdrive
