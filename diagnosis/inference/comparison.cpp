#include "diagnosis/inference/comparison.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/fitting/gap_search.hpp"
#include "diagnosis/fitting/stepwise.hpp"
#include "diagnosis/inference/bounds.hpp"

namespace wormdrive {

Evidence compare(const Hypothesis& without, const Hypothesis& with, const Candidate& candidate,
                 const InnovationLayout& layout) {
  Evidence e;
  e.delta_bic = without.bic - with.bic;
  e.of_tolerances = 2.0 * (with_tolerances(0.0, without) - with_tolerances(0.0, with));
  std::vector<std::uint8_t> out(layout.blocks, 0);
  for (std::size_t k = 0; k < layout.size; ++k)
    if (layout.part[k] == 2) out[layout.block[k]] = 1;
  std::vector<double> gains;
  double best_of_all = 0.0;
  for (std::size_t b = 0; b < layout.blocks; ++b) {
    const double gain = without.misfit.blocks[b] - with.misfit.blocks[b];
    if (out[b]) gains.push_back(gain);
    best_of_all = std::max(best_of_all, gain);
    e.everywhere_but_best += gain;
  }
  e.everywhere_but_best -= best_of_all;
  if (!gains.empty()) {
    std::sort(gains.begin(), gains.end(), [](double x, double y) { return std::abs(x) < std::abs(y); });
    const double most = rules::clip * std::abs(gains[gains.size() / 2]);
    double best = gains.front(), rank = 0.0, positive = 0.0;
    for (const double g : gains) {
      e.held_out += g;
      best = std::max(best, g);
      e.clipped += std::clamp(g, -most, most);
      rank += 1.0;
      if (g > 0.0) positive += rank;
    }
    e.without_best = e.held_out - best;
    e.positive_share = positive / (0.5 * rank * (rank + 1.0));
  }
  e.beside_gap = !candidate.impacts && gap_of(with);
  for (const Coordinate& c : candidate.coordinates) {
    const int k = index_of(with, c);
    if (k < 0) continue;
    const double x = with.values[static_cast<std::size_t>(k)];
    if (c.tolerance > 0.0) {
      e.tolerances = std::max(e.tolerances, std::abs(x - c.centre) / c.tolerance);
      if (const int before = index_of(without, c); before >= 0)
        e.tolerances_without = std::max(
            e.tolerances_without, std::abs(without.values[static_cast<std::size_t>(before)] - c.centre) / c.tolerance);
    }
    const int bound = bound_met(c, x);
    if (bound == 0 || (bound < 0 && is_removed(with, candidate))) continue;
    const bool is_limit = bound < 0 && !candidate.limiting_case.empty() && &c == &candidate.coordinates[1];
    e.at_limit = is_limit && (e.at_limit || !e.at_bound);
    e.at_bound = true;
  }
  return e;
}

bool is_removed(const Hypothesis& h, const Candidate& candidate) {
  const Coordinate& size = candidate.coordinates[0];
  const int k = index_of(h, size);
  const double none = size.low + 1e-6 * (size.high - size.low);
  return k >= 0 && size.none_at_low && size.centre > none && h.values[static_cast<std::size_t>(k)] <= none;
}

namespace {

/// Whether what was held out bears a candidate out.
bool holds(const Evidence& e, const Candidate& candidate) {
  if (e.lower_error > rules::most_of_error) return true;
  const bool gains = e.held_out > rules::least_held_out;
  const bool steady = gains && e.without_best > 0.0;
  const bool broad = e.clipped > rules::least_held_out && e.positive_share >= rules::positive_share;
  // stated parameters have gained most of it already: this one within its tolerance, or all of them far beyond theirs,
  // as far as it takes to do what the fault of a recording does
  const bool moves_back = e.of_tolerances > std::max(rules::least_bic, rules::mostly * e.delta_bic);
  if (candidate.toleranced && e.tolerances_without > rules::least_tolerances) return true;  // so do these as well
  if (candidate.toleranced || (candidate.of_recording && moves_back))
    return e.held_out > -std::max(rules::least_held_out, rules::held_out_loss * e.delta_bic);
  // teeth that bounce throw single blocks about, by more than many causes are worth
  if (e.beside_gap) return steady && broad;
  const bool has_steps = std::any_of(candidate.coordinates.begin(), candidate.coordinates.end(),
                                     [](const Coordinate& c) { return !has_slope(c); });
  return steady || broad || ((has_steps || candidate.rare) && gains && e.everywhere_but_best > rules::least_bic);
}

/// The first rule that is broken whatever was held out, empty if none is.
std::string broken_before(const Evidence& e, const Candidate& candidate) {
  if (e.at_bound) return "its parameter stands at a bound";
  if (candidate.toleranced && e.delta_bic <= rules::least_bic_toleranced)
    return "no evidence beyond the stated tolerance";
  if (candidate.toleranced && e.tolerances <= rules::least_tolerances) return "within what its tolerance leaves open";
  if (!candidate.toleranced && e.delta_bic <= rules::least_bic)
    return e.delta_bic > 0.0 ? "too little evidence" : "no evidence";
  return "";
}

/// The first rule that is broken, empty if none is.
std::string broken_rule(const Evidence& e, const Candidate& candidate) {
  const std::string rule = broken_before(e, candidate);
  return rule.empty() && !holds(e, candidate) ? "does not predict the data that were held out" : rule;
}

}  // namespace

bool accepted(const Evidence& evidence, const Candidate& candidate) { return broken_rule(evidence, candidate).empty(); }

bool refuted(const Evidence& evidence, const Candidate& candidate) {
  return broken_before(evidence, candidate).empty() && !holds(evidence, candidate);
}

bool indistinguishable_from(const Hypothesis& h, const Candidate& candidate, const Candidate& other) {
  if (candidate.limiting_case.empty() || candidate.limiting_case != other.effect) return false;
  const int k = index_of(h, candidate.coordinates[1]);
  if (k < 0) return false;
  const auto speed = static_cast<std::size_t>(k);
  return h.values[speed] < rules::fall_like_rest * h.free[speed].low;
}

std::string outcome(const Evidence& evidence, const Candidate& candidate) {
  const std::string rule = broken_rule(evidence, candidate);
  return rule.empty() ? "named" : rule;
}

}  // namespace wormdrive
