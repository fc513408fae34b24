#include "diagnosis/inference/alone.hpp"

#include <algorithm>

#include "diagnosis/fitting/fit.hpp"
#include "statistics/parallel.hpp"

namespace wormdrive {

namespace {

Hypothesis best_fit(const Evaluation& evaluation, const std::vector<Candidate>& all, std::size_t candidate,
                    const Hypothesis& base) {
  std::vector<Hypothesis> fitted(all[candidate].starts.size() + all[candidate].far.size(), base);
  parallel_for(fitted.size(), evaluation.threads(), [&](std::size_t start) {
    add_candidate(fitted[start], all, candidate, start);
    fit(evaluation, fitted[start], 6);
  });
  Hypothesis best = *std::min_element(fitted.begin(), fitted.end(),
                                      [](const Hypothesis& a, const Hypothesis& b) { return a.bic < b.bic; });
  if (best.bic >= base.bic) return best;
  constexpr int turns = 2;  // far from what is stated noise and model are found by turns
  for (int turn = 0; turn < turns; ++turn) {
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
    Hypothesis without = found.base;  // a better mixture of noise is no merit of the candidate
    without.noise = with.noise;
    fit(evaluation, without, 5);
    const Evidence evidence =
        compare(without.objective < found.base.objective ? without : found.base, with, all[c], evaluation.layout());
    found.tried.push_back({c, with, evidence});
    if (!accepted(evidence, all[c]) || with.bic >= found.model.bic) continue;
    found.model = std::move(with);
    found.causes = {{c, {}}};
    found.beyond_bound.reset();
  }
}

}  // namespace wormdrive
