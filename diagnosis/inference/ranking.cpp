#include "diagnosis/inference/ranking.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "diagnosis/inference/intervals.hpp"

namespace wormdrive {

std::vector<RankedCandidate> ranking(const Evaluation& evaluation, const Selection& selection,
                                     const std::vector<Candidate>& all) {
  std::vector<RankedCandidate> list;
  const auto is_cause = [&](std::size_t candidate) {
    return std::any_of(selection.causes.begin(), selection.causes.end(),
                       [&](const Found& f) { return f.candidate == candidate; });
  };
  for (const Tried& t : selection.tried) {
    RankedCandidate c;
    const Candidate& candidate = all[t.candidate];
    c.effect = estimated(t.model, covariance(evaluation, t.model, 0), candidate.effect, candidate.coordinates);
    c.delta_bic = t.evidence.delta_bic;
    c.held_out_gain = t.evidence.held_out;
    c.named = is_cause(t.candidate);
    c.outcome = c.named ? "named" : outcome(t.evidence, candidate);
    if (!c.named && c.outcome == "named") c.outcome = "another one explains it better";
    list.push_back(std::move(c));
  }
  for (const Screened& s : selection.screened) {
    if (std::any_of(list.begin(), list.end(),
                    [&](const RankedCandidate& c) { return c.effect.effect == all[s.candidate].effect; }))
      continue;
    RankedCandidate c;
    c.effect.effect = all[s.candidate].effect;
    for (const Coordinate& x : all[s.candidate].coordinates) {
      const int k = index_of(s.model, x);
      if (k < 0 || x.form != CoordinateForm::plain) continue;
      // one step of a linear fit has no error that is worth telling
      constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
      c.effect.parameters.push_back({std::string(x.field), field_of({}, x.effect, x.field).unit,
                                     s.model.values[static_cast<std::size_t>(k)], unknown, unknown, unknown});
    }
    c.delta_bic = s.gain;
    c.named = is_cause(s.candidate);
    c.outcome = c.named ? "named" : "promises too little to be fitted";
    list.push_back(std::move(c));
  }
  // what is named comes first: a richer law that contains it has the higher evidence and is not named for it
  std::stable_sort(list.begin(), list.end(), [](const RankedCandidate& a, const RankedCandidate& b) {
    return a.named != b.named ? a.named : a.delta_bic > b.delta_bic;
  });
  return list;
}

}  // namespace wormdrive
