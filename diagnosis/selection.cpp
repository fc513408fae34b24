#include "diagnosis/selection.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "diagnosis/bounces.hpp"
#include "diagnosis/fit.hpp"
#include "diagnosis/intervals.hpp"
#include "diagnosis/laws.hpp"
#include "diagnosis/parallel.hpp"
#include "diagnosis/prediction_error.hpp"

namespace wormdrive {

namespace {

void finish_with_noise_model(const Evaluation& by, Hypothesis& h, const ProcessNoise& noise) {
  h.whitens = true;
  h.noise = noise;
  evaluate(by, h);
  restart_noise(by, h);
  fit(by, h, 5);
}

}  // namespace

Start fitted_start(const Evaluation& by, const std::vector<Suspect>& all, Hypothesis base) {
  evaluate(by, base);
  adjust_noise(by, base, 6);
  fit(by, base, 6);
  adjust_noise(by, base, 6);
  fit(by, base, 2);
  if (base.whitens) {
    Hypothesis second = without_noise_model(base);
    fit(by, second, 5);
    finish_with_noise_model(by, second, base.noise);
    if (second.objective < base.objective) base = std::move(second);
  }
  Screening screening = screen(by, base, all);
  return {std::move(base), std::move(screening)};
}

void CauseSearch::select(const Start& start, const Start* other) {
  s_.base = s_.model = start.base;
  s_.screening = start.screening;
  for (int round = 0; round < most_causes_; ++round) {
    tell(fmt::format("trying suspects, round {}", round + 1));
    const bool first = round == 0;
    std::vector<Tried> tried =
        first ? try_suspects(start, other) : try_suspects({s_.model, screen(by_, s_.model, all_)}, nullptr);
    if (first) s_.tried = tried;
    const double before = s_.model.bic;
    if (tried.empty() || !take_best(tried, first)) break;
    eliminate(before);
  }
  simplify();
  s_.linear = linear_system(by_, s_.base, s_.screening);
}

Selection CauseSearch::confirmed() {
  confirm_classes();
  judge_freed_numbers();
  return std::move(s_);
}

/// The best starts of the suspects that promise most.
std::vector<Screened> CauseSearch::worth_fitting(const std::vector<Screened>& found) const {
  constexpr std::size_t most_suspects = 6, most = 12;
  std::vector<Screened> worth;
  std::vector<std::size_t> seen;
  const double best = found.empty() ? 0.0 : found.front().gain;
  for (const Screened& s : found) {
    if (worth.size() >= most || std::isinf(s.gain)) break;
    const auto starts = std::count(seen.begin(), seen.end(), s.suspect);
    const auto suspects = std::count_if(seen.begin(), seen.end(), [&](std::size_t c) { return c != s.suspect; });
    if (starts >= 2) continue;
    if (starts == 1) {
      const auto known =
          std::find_if(worth.begin(), worth.end(), [&](const auto& w) { return w.suspect == s.suspect; });
      if (s.gain < 0.5 * known->gain || s.gain < 0.3 * best) continue;
    } else if (static_cast<std::size_t>(suspects) >= most_suspects && s.gain < 0.4 * best) {
      continue;
    }
    seen.push_back(s.suspect);
    worth.push_back(s);
  }
  return worth;
}

std::vector<Tried> CauseSearch::try_suspects(const Start& start, const Start* other) {
  const Hypothesis& current = start.base;
  const std::vector<Screened> worth = worth_fitting(start.screening.found);
  std::vector<Hypothesis> fitted(worth.size());
  parallel_for(worth.size(), by_.threads(), [&](std::size_t k) {
    fitted[k] = worth[k].model;
    fit(by_, fitted[k], 6, 0.5);
  });
  std::vector<Tried> tried;
  const auto keep = [&](std::size_t suspect, Hypothesis model) {
    const auto known = std::find_if(tried.begin(), tried.end(), [&](const Tried& t) { return t.suspect == suspect; });
    if (known == tried.end())
      tried.push_back({suspect, std::move(model), {}});
    else if (model.bic < known->model.bic)
      known->model = std::move(model);
  };
  for (std::size_t k = 0; k < worth.size(); ++k) keep(worth[k].suspect, std::move(fitted[k]));
  if (other)
    for (Tried& t : try_from(*other, current)) keep(t.suspect, std::move(t.model));
  const auto by_bic = [](const Tried& a, const Tried& b) { return a.model.bic < b.model.bic; };
  std::stable_sort(tried.begin(), tried.end(), by_bic);
  const std::size_t polished = std::min<std::size_t>(3, tried.size());
  const double worth_refining = reach_share * (s_.base.bic - current.bic);
  for (std::size_t k = 0; k < polished; ++k) {  // one after the other: each takes all threads itself
    Hypothesis& h = tried[k].model;
    const double gain = current.bic - h.bic;
    if (all_[tried[k].suspect].bounces && gain > 0.0)
      find_bounces(by_, h);
    else if (gain > worth_refining)
      refine_bounces(by_, h);
    if (gain <= AcceptanceRules{}.least_bic) continue;
    try_other_laws(by_, h, all_[tried[k].suspect]);
    for (const Found& found : s_.causes)  // a law that stood in for a number it frees may not be the best beside it
      if (all_[found.suspect].frees == all_[tried[k].suspect].effect) try_other_laws(by_, h, all_[found.suspect]);
  }
  parallel_for(polished, by_.threads(), [&](std::size_t k) {
    Hypothesis& h = tried[k].model;
    if (h.bic >= current.bic) return;
    restart_noise(by_, h);
    adjust_noise(by_, h, 3);
    fit(by_, h, 4);
  });
  std::stable_sort(tried.begin(), tried.end(), by_bic);
  for (Tried& t : tried) t.evidence = compare(current, t.model, all_[t.suspect], by_.layout());
  return tried;
}

/// The suspects that do best at another start, with the noise model of the current hypothesis.
std::vector<Tried> CauseSearch::try_from(const Start& other, const Hypothesis& current) const {
  constexpr std::size_t most = 3;
  constexpr double least_gain = 10.0;
  std::vector<Tried> tried;
  for (const Screened& s : other.screening.found) {
    if (tried.size() >= most || s.gain < least_gain) break;
    if (std::none_of(tried.begin(), tried.end(), [&](const Tried& t) { return t.suspect == s.suspect; }))
      tried.push_back({s.suspect, s.model, {}});
  }
  parallel_for(tried.size(), by_.threads(), [&](std::size_t k) {
    fit(by_, tried[k].model, 4);
    finish_with_noise_model(by_, tried[k].model, current.noise);
  });
  return tried;
}

/// A better optimum of what both share, or a better mixture of noise, is no merit of the suspect: the simpler model is
/// fitted again from there.
void CauseSearch::compare_fairly(Tried& with, bool base_too) {
  Hypothesis simpler = s_.model;
  simpler.noise = with.model.noise;
  for (std::size_t k = 0; k < simpler.free.size(); ++k) {
    const auto& own = all_[with.suspect].coordinates;
    if (std::any_of(own.begin(), own.end(), [&](const Coordinate& c) { return c.is(simpler.free[k]); })) continue;
    const int there = index_of(with.model, simpler.free[k]);
    if (there >= 0) simpler.values[k] = with.model.values[static_cast<std::size_t>(there)];
  }
  fit(by_, simpler, 5);
  refine_bounces(by_, simpler);
  if (simpler.objective < s_.model.objective) {
    s_.model = std::move(simpler);
    if (base_too) s_.base = s_.model;
  }
  with.evidence = compare(s_.model, with.model, all_[with.suspect], by_.layout());
}

/// Long data find traces of what is of no account. A further cause has to lower the error ahead as well, or to gain
/// more than all before it: how teeth bounce over a wide gap nobody can predict.
bool CauseSearch::matters(const Tried& with) const {
  constexpr double least_share = 0.01;
  return s_.causes.empty() || with.evidence.delta_bic > s_.base.bic - s_.model.bic ||
         error_ahead(by_, with.model, told_horizon) < (1.0 - least_share) * error_ahead(by_, s_.model, told_horizon);
}

/// Whether the data bear a cause out beside others. What the law of an impact, or of a fall over the speed, gets wrong
/// grows with what a gap or a fall explains, and passes for small causes, beside a gap of some size by chance.
bool CauseSearch::stands(const Evidence& evidence, const Hypothesis& with, const Suspect& suspect) const {
  if (!accepted(evidence, suspect)) return false;
  const bool beside_fall = suspect.effect != "stribeck" && index_of(with, "stribeck", "drop") >= 0;
  if (!evidence.beside_gap && !beside_fall) return true;
  if (evidence.delta_bic <= reach_share * (s_.base.bic - with.bic)) return false;
  if (!evidence.beside_gap) return true;
  const EstimatedEffect found = estimated(with, covariance(by_, with, 1), suspect.effect, suspect.coordinates);
  const Estimate& size = found.parameters.front();
  const double stated = field_of(by_.scenario().effects, found.effect, size.field).value;
  return stated < size.low || stated > size.high;
}

bool CauseSearch::take_best(std::vector<Tried>& tried, bool first_round) {
  // What stands at a bound is not what its name says; it must not keep others out.
  std::stable_partition(tried.begin(), tried.end(), [](const Tried& t) { return !t.evidence.at_bound; });
  const double best = tried.front().evidence.delta_bic;
  // Among equals the one with the fewest parameters comes first.
  constexpr double as_good = 6.0;
  auto first = tried.begin();
  for (auto t = tried.begin(); t != tried.end(); ++t)
    if (!t->evidence.at_bound && best - t->evidence.delta_bic < as_good &&
        t->model.free.size() < first->model.free.size())
      first = t;
  std::rotate(tried.begin(), first, first + 1);

  for (std::size_t k = 0; k < tried.size(); ++k) {
    Tried& t = tried[k];
    if (best - t.evidence.delta_bic > reach(best)) break;
    const Suspect& suspect = all_[t.suspect];
    if (t.evidence.delta_bic > (suspect.toleranced ? 0.0 : AcceptanceRules{}.least_bic)) compare_fairly(t, first_round);
    if (first_round)
      for (Tried& kept : s_.tried)
        if (kept.suspect == t.suspect) kept.evidence = t.evidence;
    if (!stands(t.evidence, t.model, suspect) || !matters(t)) continue;
    Found found{t.suspect, {}};
    for (const Tried& other : tried) {
      const Suspect& rival = all_[other.suspect];
      if (other.suspect == t.suspect || other.evidence.at_bound || rival.frees == suspect.effect) continue;
      if (t.evidence.delta_bic - other.evidence.delta_bic < reach(best) ||
          (passes_for(t.model, suspect, rival) && accepted(other.evidence, rival)))
        found.equals.push_back(other.suspect);
    }
    s_.causes.push_back(found);
    s_.model = t.model;
    return true;
  }
  return false;
}

}  // namespace wormdrive
