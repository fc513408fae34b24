#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/fitting/gap_search.hpp"
#include "diagnosis/inference/intervals.hpp"
#include "diagnosis/inference/masked_pairs.hpp"
#include "diagnosis/inference/selection.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "statistics/parallel.hpp"

// What a search does with causes once it has them: it drops, simplifies and exchanges them.

namespace wormdrive {

namespace {

std::vector<std::size_t> candidates_of(const std::vector<Found>& causes) {
  std::vector<std::size_t> all;
  for (const Found& f : causes) all.push_back(f.candidate);
  return all;
}

/// The same with another candidate in the place of one; none where that one is among them already.
std::vector<std::size_t> exchanged(const std::vector<Found>& causes, std::size_t one, std::size_t other) {
  std::vector<std::size_t> all = candidates_of(causes);
  std::replace(all.begin(), all.end(), one, other);
  return std::count(all.begin(), all.end(), other) > 1 ? std::vector<std::size_t>{} : all;
}

}  // namespace

/// The base with some causes, from the values of a warm hypothesis where it has them.
Hypothesis CauseSearch::fit_causes(const std::vector<std::size_t>& causes, const Hypothesis* warm, int rounds) const {
  Hypothesis h = s_.base;
  for (const std::size_t c : causes) add_candidate(h, all_, c, all_[c].starts.size() > 1 ? 1 : 0);
  if (warm) {
    for (std::size_t k = 0; k < h.free.size(); ++k) {
      const int there = index_of(*warm, h.free[k]);
      if (there >= 0) h.values[k] = warm->values[static_cast<std::size_t>(there)];
    }
    h.noise = warm->noise;
    for (const std::size_t c : causes)
      for (const FieldValue& f : all_[c].starts.front().chosen)
        if (field_of(warm->drive, f.effect, f.field).on)
          set_field(h.drive, {f.effect, f.field, field_of(warm->drive, f.effect, f.field).value});
  }
  fit(evaluation_, h, rounds);
  return h;
}

/// Drops causes that do not stand beside the last one, if what is left is better than enough, a BIC.
void CauseSearch::eliminate(double enough) {
  for (bool again = s_.causes.size() >= 2; again;) {
    again = false;
    for (std::size_t k = 0; k + 1 < s_.causes.size(); ++k) {
      std::vector<std::size_t> rest;
      for (std::size_t j = 0; j < s_.causes.size(); ++j)
        if (j != k) rest.push_back(s_.causes[j].candidate);
      Hypothesis without = fit_causes(rest, &s_.model, 6);
      adjust_noise(evaluation_, without, 3);
      refine_gap(evaluation_, without);
      const Candidate& candidate = all_[s_.causes[k].candidate];
      if (without.bic > enough || supported(judged(without, s_.model, candidate), s_.model, candidate)) continue;
      s_.model = std::move(without);
      s_.causes.erase(s_.causes.begin() + static_cast<std::ptrdiff_t>(k));
      again = true;
      break;
    }
  }
}

/// A candidate that frees a stated parameter gives way to that number alone where this does nearly as well.
void CauseSearch::simplify() {
  for (Found& found : s_.causes) {
    const Candidate& candidate = all_[found.candidate];
    const auto simple = std::find_if(all_.begin(), all_.end(), [&](const Candidate& x) {
      return !candidate.frees.empty() && x.effect == candidate.frees;
    });
    if (simple == all_.end()) continue;
    const auto index = static_cast<std::size_t>(simple - all_.begin());
    const std::vector<std::size_t> causes = exchanged(s_.causes, found.candidate, index);
    if (causes.empty()) continue;
    Hypothesis simpler = fit_causes(causes, &s_.model, 6);
    if (simpler.bic >= s_.model.bic + rules::as_good) continue;
    const bool as_good = s_.model.bic < simpler.bic + rules::as_good;
    found = {index, as_good ? std::vector{found.candidate} : std::vector<std::size_t>{}};
    s_.model = std::move(simpler);
  }
}

void CauseSearch::try_pairs() {
  if (most_causes_ < 2) return;
  tell("trying pairs");
  const double have = s_.base.bic - s_.model.bic;
  const double margin = clear_margin(have);
  const std::vector<MaskedPair> pairs =
      masked_pairs(s_.linear, s_.base, all_, candidates_of(s_.causes), rules::most_pairs);
  std::vector<Hypothesis> fitted(pairs.size());
  parallel_for(pairs.size(), evaluation_.threads(), [&](std::size_t k) {
    Hypothesis& h = fitted[k];
    h = s_.base;
    add_candidate(h, all_, pairs[k].first, pairs[k].first_start);
    add_candidate(h, all_, pairs[k].second, pairs[k].second_start);
    fit(evaluation_, h, 10);
    adjust_noise(evaluation_, h, 3);
    fit(evaluation_, h, 3);
  });
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Hypothesis& h = fitted[k];
    const bool fewer = s_.causes.size() > 2;  // that do as well are the better explanation
    if (h.bic >= s_.model.bic - (fewer ? 0.0 : margin)) continue;
    const Candidate &a = all_[pairs[k].first], &b = all_[pairs[k].second];
    std::vector<std::size_t> now = candidates_of(s_.causes);
    std::sort(now.begin(), now.end());
    if (now == std::vector{std::min(pairs[k].first, pairs[k].second), std::max(pairs[k].first, pairs[k].second)})
      continue;
    Candidate unstated;  // the pair as a whole is judged by the data that were held out
    if (!fewer && !accepted(judged(s_.model, h, unstated), unstated)) continue;
    std::array<Hypothesis, 2> half;
    parallel_for(half.size(), evaluation_.threads(), [&](std::size_t q) {
      half[q] = fit_causes({q == 0 ? pairs[k].first : pairs[k].second}, &h, 6);
      refine_gap(evaluation_, half[q]);
    });
    if (!supported(judged(half[1], h, a), h, a) || !supported(judged(half[0], h, b), h, b)) continue;
    s_.model = h;
    s_.causes = {{pairs[k].first, {}}, {pairs[k].second, {}}};
  }
  while (s_.causes.size() > 2 && exchange_for_fewer()) {
  }
  simplify();
}

/// Of what did as well as a cause one may make another cause superfluous: fewer that do as well are the better
/// explanation. False if there is no such one.
bool CauseSearch::exchange_for_fewer() {
  for (const Found& found : s_.causes)
    for (const std::size_t other : found.equals)
      for (const Found& superfluous : s_.causes) {
        std::vector<std::size_t> rest = exchanged(s_.causes, found.candidate, other);
        if (superfluous.candidate == found.candidate || std::erase(rest, superfluous.candidate) == 0) continue;
        Hypothesis fewer = fit_causes(rest, &s_.model, 10);
        adjust_noise(evaluation_, fewer, 3);
        fit(evaluation_, fewer, 3);
        if (fewer.bic >= s_.model.bic) continue;
        s_.model = std::move(fewer);
        s_.causes.clear();
        for (const std::size_t candidate : rest) s_.causes.push_back({candidate, {}});
        return true;
      }
  return false;
}

/// What did as well when a cause was found need not do so beside the causes that came later.
void CauseSearch::confirm_classes() {
  if (s_.causes.size() < 2) return;
  const double enough = s_.model.bic + equivalence_margin(s_.base.bic - s_.model.bic);
  for (Found& found : s_.causes)
    std::erase_if(found.equals, [&](std::size_t other) {
      if (indistinguishable_from(s_.model, all_[found.candidate], all_[other])) return false;
      const std::vector<std::size_t> causes = exchanged(s_.causes, found.candidate, other);
      if (causes.empty()) return true;
      Hypothesis rival = fit_causes(causes, &s_.model, 8);
      adjust_noise(evaluation_, rival, 3);
      fit(evaluation_, rival, 4);
      return rival.bic > enough;
    });
}

/// A stated parameter far beyond its tolerance is a cause, whatever else is one: the one first that gains most by being
/// free of it.
void CauseSearch::name_far_numbers() {
  const auto freed = [&](std::size_t number) {
    return std::any_of(s_.causes.begin(), s_.causes.end(), [&](const Found& found) {
      return found.candidate == number || all_[found.candidate].frees == all_[number].effect;
    });
  };
  for (bool again = !s_.causes.empty(); again;) {
    again = false;
    std::vector<Tried> tried;
    for (std::size_t k = 0; k < all_.size(); ++k) {
      if (!all_[k].toleranced || freed(k)) continue;
      const Coordinate& c = all_[k].coordinates[0];
      const int at = index_of(s_.model, c);
      // its tolerance draws a number back, from where it would be far off without it
      if (at < 0 || std::abs(s_.model.values[static_cast<std::size_t>(at)] - c.centre) <
                        rules::suspicious * rules::least_tolerances * c.tolerance)
        continue;
      Tried t{k, s_.model, {}};
      add_candidate(t.model, all_, k, 0);
      fit(evaluation_, t.model, 6);
      t.evidence = judged(s_.model, t.model, all_[k]);
      if (supported(t.evidence, t.model, all_[k])) tried.push_back(std::move(t));
    }
    const auto best = std::max_element(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) {
      return a.evidence.delta_bic < b.evidence.delta_bic;
    });
    if (best == tried.end()) return;
    const double before = s_.model.bic;
    s_.causes.push_back({best->candidate, {}});
    s_.model = std::move(best->model);
    eliminate(before);
    again = true;
  }
}

/// A stated parameter that a cause frees is a part of its law, and no cause beside it unless it has moved far.
void CauseSearch::judge_freed_numbers() {
  for (std::size_t k = 0; k < all_.size(); ++k) {
    const Candidate& number = all_[k];
    if (std::none_of(s_.causes.begin(), s_.causes.end(),
                     [&](const Found& found) { return all_[found.candidate].frees == number.effect; }))
      continue;
    const auto known =
        std::find_if(s_.causes.begin(), s_.causes.end(), [&](const Found& found) { return found.candidate == k; });
    const Coordinate& stated = number.coordinates[0];
    bool moved = false;
    if (index_of(s_.model, stated) >= 0) {
      const Estimate now =
          estimated(s_.model, covariance(evaluation_, s_.model, 1), number.effect, number.coordinates).parameters[0];
      moved = std::abs(now.value - stated.centre) >
              rules::least_tolerances * std::hypot(stated.tolerance, now.standard_error);
    }
    if (!moved && known != s_.causes.end()) s_.causes.erase(known);
    if (moved && known == s_.causes.end()) s_.causes.push_back({k, {}});
  }
}

}  // namespace wormdrive
