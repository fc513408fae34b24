#include "diagnosis/inference/selection.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/fitting/gap_search.hpp"
#include "diagnosis/fitting/laws.hpp"
#include "diagnosis/fitting/prediction_error.hpp"
#include "diagnosis/inference/bounds.hpp"
#include "diagnosis/inference/intervals.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "diagnosis/rules/noise.hpp"
#include "statistics/parallel.hpp"

namespace wormdrive {

namespace {

void finish_with_noise_model(const Evaluation& evaluation, Hypothesis& h, const ProcessNoise& noise) {
  h.whitens = true;
  h.noise = noise;
  evaluate(evaluation, h);
  restart_noise(evaluation, h);
  fit(evaluation, h, 5);
}

}  // namespace

Start fitted_start(const Evaluation& evaluation, const std::vector<Candidate>& all, Hypothesis base) {
  evaluate(evaluation, base);
  adjust_noise(evaluation, base, 6);
  fit(evaluation, base, 6);
  adjust_noise(evaluation, base, 6);
  fit(evaluation, base, 2);
  if (base.whitens) {
    Hypothesis second = without_noise_model(base);
    fit(evaluation, second, 5);
    finish_with_noise_model(evaluation, second, base.noise);
    if (explains_better(second, base)) base = std::move(second);
  }
  Screening screening = screen(evaluation, base, all);
  return {std::move(base), std::move(screening)};
}

void CauseSearch::select(Start start, const Start* other) {
  s_.base = s_.model = start.base;
  const auto removed = [&] {  // an effect that is taken away leaves room for another
    return std::count_if(s_.causes.begin(), s_.causes.end(),
                         [&](const Found& found) { return is_removed(s_.model, all_[found.candidate]); });
  };
  for (int round = 0; round < most_causes_ + removed(); ++round) {
    tell(fmt::format("trying candidates, round {}", round + 1));
    const bool first = round == 0;
    if (!first) start = {s_.model, screen(evaluation_, s_.model, all_)};
    std::vector<Tried> tried = try_candidates(start, first ? other : nullptr);
    if (first) s_.tried = tried;
    const double before = s_.model.bic;
    const bool any = !tried.empty() && take_best(tried, first);
    if (first) {  // of long recordings signatures take most of the memory
      s_.linear = linear_system(evaluation_, s_.base, start.screening);
      for (Screened& s : start.screening.found) s.signatures = {};
      s_.screened = std::move(start.screening.found);
    }
    if (!any) break;
    eliminate(before);
  }
  simplify();
}

Selection CauseSearch::confirmed() {
  name_far_numbers();
  confirm_classes();
  judge_freed_numbers();
  return std::move(s_);
}

/// The best starts of the candidates that promise most.
std::vector<Screened> CauseSearch::worth_fitting(const std::vector<Screened>& found) const {
  std::vector<Screened> worth;
  std::vector<std::size_t> seen;
  const double best = found.empty() ? 0.0 : found.front().gain;
  for (const Screened& s : found) {
    if (worth.size() >= rules::most_starts || std::isinf(s.gain)) break;
    const auto starts = std::count(seen.begin(), seen.end(), s.candidate);
    const auto candidates = std::count_if(seen.begin(), seen.end(), [&](std::size_t c) { return c != s.candidate; });
    if (starts >= 2) continue;
    if (starts == 1) {
      const auto known =
          std::find_if(worth.begin(), worth.end(), [&](const auto& w) { return w.candidate == s.candidate; });
      if (s.gain < rules::second_start * known->gain || s.gain < rules::second_start_of_best * best) continue;
    } else if (static_cast<std::size_t>(candidates) >= rules::most_fitted && s.gain < rules::late_candidate * best) {
      continue;
    }
    seen.push_back(s.candidate);
    worth.push_back(s);
  }
  return worth;
}

std::vector<Tried> CauseSearch::try_candidates(const Start& start, const Start* other) {
  const Hypothesis& current = start.base;
  const std::vector<Screened> worth = worth_fitting(start.screening.found);
  std::vector<Hypothesis> fitted(worth.size());
  parallel_for(worth.size(), evaluation_.threads(), [&](std::size_t k) {
    fitted[k] = worth[k].model;
    fit(evaluation_, fitted[k], 6, 0.5);
  });
  std::vector<Tried> tried;
  const auto keep = [&](std::size_t candidate, Hypothesis model) {
    const auto known =
        std::find_if(tried.begin(), tried.end(), [&](const Tried& t) { return t.candidate == candidate; });
    if (known == tried.end())
      tried.push_back({candidate, std::move(model), {}});
    else if (model.bic < known->model.bic)
      known->model = std::move(model);
  };
  for (std::size_t k = 0; k < worth.size(); ++k) keep(worth[k].candidate, std::move(fitted[k]));
  if (other)
    for (Tried& t : try_from(*other, current)) keep(t.candidate, std::move(t.model));
  const auto by_bic = [](const Tried& a, const Tried& b) { return a.model.bic < b.model.bic; };
  std::stable_sort(tried.begin(), tried.end(), by_bic);
  const std::size_t polished = std::min(rules::most_refined, tried.size());
  const double worth_refining = rules::equivalence_share * (s_.base.bic - current.bic);
  for (std::size_t k = 0; k < polished; ++k) {  // one after the other: each takes all threads itself
    Hypothesis& h = tried[k].model;
    const double gain = current.bic - h.bic;
    if (all_[tried[k].candidate].impacts && gain > 0.0)
      find_gap(evaluation_, h);
    else if (gain > worth_refining)
      refine_gap(evaluation_, h);
    if (gain <= rules::least_bic) continue;
    try_other_laws(evaluation_, h, all_[tried[k].candidate]);
    for (const Found& found : s_.causes)  // a law that stood in for a number it frees may not be the best beside it
      if (all_[found.candidate].frees == all_[tried[k].candidate].effect)
        try_other_laws(evaluation_, h, all_[found.candidate]);
  }
  parallel_for(polished, evaluation_.threads(), [&](std::size_t k) {
    Hypothesis& h = tried[k].model;
    if (h.bic >= current.bic) return;
    // far from what is stated noise and model are found by turns: each hides what the other one lacks
    double before = std::numeric_limits<double>::infinity();
    for (int turn = 0; turn < rules::most_turns && before - h.objective > rules::least_bic; ++turn) {
      before = h.objective;
      restart_noise(evaluation_, h);
      adjust_noise(evaluation_, h, 3);
      fit(evaluation_, h, 4);
    }
  });
  for (std::size_t k = 0; k < polished; ++k)
    if (tried[k].model.bic < current.bic) leave_bounds(evaluation_, tried[k].model, all_[tried[k].candidate]);
  std::stable_sort(tried.begin(), tried.end(), by_bic);
  for (Tried& t : tried) t.evidence = judged(current, t.model, all_[t.candidate]);
  return tried;
}

/// The candidates that do best at another start, with the noise model of the current hypothesis.
std::vector<Tried> CauseSearch::try_from(const Start& other, const Hypothesis& current) const {
  std::vector<Tried> tried;
  for (const Screened& s : other.screening.found) {
    if (tried.size() >= rules::most_from_other || s.gain < rules::least_from_other) break;
    if (std::none_of(tried.begin(), tried.end(), [&](const Tried& t) { return t.candidate == s.candidate; }))
      tried.push_back({s.candidate, s.model, {}});
  }
  parallel_for(tried.size(), evaluation_.threads(), [&](std::size_t k) {
    fit(evaluation_, tried[k].model, 4);
    finish_with_noise_model(evaluation_, tried[k].model, current.noise);
  });
  return tried;
}

/// A better optimum of what both share, or a better mixture of noise, is no merit of the candidate: the simpler model
/// is fitted again from there.
void CauseSearch::compare_fairly(Tried& with, bool base_too) {
  Hypothesis simpler = s_.model;
  simpler.noise = with.model.noise;
  for (std::size_t k = 0; k < simpler.free.size(); ++k) {
    const auto& own = all_[with.candidate].coordinates;
    if (std::any_of(own.begin(), own.end(), [&](const Coordinate& c) { return c.is(simpler.free[k]); })) continue;
    const int there = index_of(with.model, simpler.free[k]);
    if (there >= 0) simpler.values[k] = with.model.values[static_cast<std::size_t>(there)];
  }
  fit(evaluation_, simpler, 5);
  refine_gap(evaluation_, simpler);
  if (simpler.objective < s_.model.objective) {
    s_.model = std::move(simpler);
    if (base_too) s_.base = s_.model;
  }
  with.evidence = judged(s_.model, with.model, all_[with.candidate]);
}

/// How two models compare. Where teeth bounce, one bounce that goes another way costs held-out data more nats than a
/// cause is worth: what the error ahead says then is bounded.
Evidence CauseSearch::judged(const Hypothesis& without, const Hypothesis& with, const Candidate& candidate) const {
  Evidence e = compare(without, with, candidate, evaluation_.layout());
  if (refuted(e, candidate)) e.lower_error = share_of_error(evaluation_, without, with, rules::reported_horizon);
  return e;
}

/// Long data find traces of what is of no account. A further cause has to lower the error ahead as well, or to gain
/// more than all before it: how teeth bounce over a wide gap nobody can predict.
bool CauseSearch::improves_prediction(const Tried& with) const {
  // a stated parameter lowers it without being named, within its tolerance
  return s_.causes.empty() || all_[with.candidate].toleranced || with.evidence.delta_bic > s_.base.bic - s_.model.bic ||
         error_ahead(evaluation_, with.model, rules::reported_horizon) <
             (1.0 - rules::least_improvement) * error_ahead(evaluation_, s_.model, rules::reported_horizon);
}

/// Whether the data bear a cause out beside others. What the law of an impact, or of a fall over the speed, gets wrong
/// grows with what a gap or a fall explains, and passes for small causes, beside a gap of some size by chance.
bool CauseSearch::supported(const Evidence& evidence, const Hypothesis& with, const Candidate& candidate) const {
  if (!accepted(evidence, candidate)) return false;
  const bool beside_fall = !candidate.falls && std::any_of(all_.begin(), all_.end(), [&](const Candidate& other) {
    return other.falls && index_of(with, other.coordinates.front()) >= 0;
  });
  if (!evidence.beside_gap && !beside_fall) return true;
  if (evidence.delta_bic <= rules::equivalence_share * (s_.base.bic - with.bic)) return false;
  if (!evidence.beside_gap) return true;
  const EstimatedEffect found =
      estimated(with, covariance(evaluation_, with, 1), candidate.effect, candidate.coordinates);
  const Estimate& size = found.parameters.front();
  const double stated = field_of(RecordedDrive(evaluation_.scenario().effects), found.effect, size.field).value;
  return stated < size.low || stated > size.high;
}

bool CauseSearch::take_best(std::vector<Tried>& tried, bool first_round) {
  // What stands at a bound is not what its name says, unless it is its limiting case there and this holds as well. One
  // that far outdoes all others leaves no room for a smaller name.
  const auto holds_as_limit = [&](const Tried& t) {
    return t.evidence.at_limit && std::ranges::any_of(tried, [&](const Tried& other) {
             const Candidate& limit = all_[other.candidate];
             return limit.effect == all_[t.candidate].limiting_case && accepted(other.evidence, limit);
           });
  };
  const auto stands_at_bound = [&](const Tried& t) { return t.evidence.at_bound && !holds_as_limit(t); };
  const Evidence& first_of_all = tried.front().evidence;
  double best_within = 0.0;
  for (const Tried& t : tried)
    if (!stands_at_bound(t)) best_within = std::max(best_within, t.evidence.delta_bic);
  if (stands_at_bound(tried.front()) && first_of_all.held_out > rules::least_held_out &&
      first_of_all.delta_bic > rules::least_bic + rules::far_beyond * best_within) {
    s_.beyond_bound = tried.front().candidate;
    return false;
  }
  // a gap that is refuted may be borne out beside a cause that is missing, and leaves room for it
  std::stable_partition(tried.begin(), tried.end(), [&](const Tried& t) {
    return !stands_at_bound(t) && !(all_[t.candidate].impacts && refuted(t.evidence, all_[t.candidate]));
  });
  const double best = tried.front().evidence.delta_bic;
  // Among equals the one with the fewest parameters comes first.
  auto first = tried.begin();
  for (auto t = tried.begin(); t != tried.end(); ++t)
    if (!stands_at_bound(*t) && best - t->evidence.delta_bic < rules::as_good &&
        t->model.free.size() < first->model.free.size())
      first = t;
  std::rotate(tried.begin(), first, first + 1);

  for (std::size_t k = 0; k < tried.size(); ++k) {
    Tried& t = tried[k];
    if (best - t.evidence.delta_bic > equivalence_margin(best)) break;
    const Candidate& candidate = all_[t.candidate];
    if (t.evidence.delta_bic > (candidate.toleranced ? 0.0 : rules::least_bic)) compare_fairly(t, first_round);
    if (first_round)
      for (Tried& kept : s_.tried)
        if (kept.candidate == t.candidate) kept.evidence = t.evidence;
    Evidence evidence = t.evidence;
    evidence.at_bound = stands_at_bound(t);
    if (!supported(evidence, t.model, candidate) || !improves_prediction(t)) continue;
    Found found{t.candidate, {}};
    for (const Tried& other : tried) {
      const Candidate& rival = all_[other.candidate];
      if (other.candidate == t.candidate || other.evidence.at_bound) continue;
      // what has the number within it does as well by nature: its other parameters have to earn their price, or to tell
      // more of what was fitted and of what was held out
      const bool contains = rival.frees == candidate.effect;
      const bool foretells = contains && accepted(other.evidence, rival) &&
                             t.model.objective - other.model.objective > rules::least_held_out &&
                             other.evidence.held_out > t.evidence.held_out + rules::least_held_out;
      if (contains && !foretells && other.evidence.delta_bic <= t.evidence.delta_bic - rules::as_good) continue;
      // a delay that is stated and is not there shows as a torque that comes late by it
      if (rival.of_recording && is_removed(t.model, candidate)) continue;
      if (foretells || t.evidence.delta_bic - other.evidence.delta_bic < equivalence_margin(best) ||
          (indistinguishable_from(t.model, candidate, rival) && accepted(other.evidence, rival)))
        found.equals.push_back(other.candidate);
    }
    s_.causes.push_back(found);
    s_.model = t.model;
    return true;
  }
  return false;
}

}  // namespace wormdrive
