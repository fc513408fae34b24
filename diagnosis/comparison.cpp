#include "diagnosis/comparison.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/stepwise.hpp"

namespace wormdrive {

Evidence compare(const Hypothesis& without, const Hypothesis& with, const Suspect& suspect,
                 const InnovationLayout& layout) {
  Evidence e;
  e.delta_bic = without.bic - with.bic;
  std::vector<std::uint8_t> out(layout.blocks, 0);
  for (std::size_t k = 0; k < layout.size; ++k)
    if (layout.part[k] == 2) out[layout.block[k]] = 1;
  std::vector<double> gains, sizes;
  for (std::size_t b = 0; b < layout.blocks; ++b)
    if (out[b]) gains.push_back(without.misfit.blocks[b] - with.misfit.blocks[b]);
  if (!gains.empty()) {
    double best = gains.front();
    for (const double g : gains) {
      e.held_out += g;
      best = std::max(best, g);
      e.positive_share += (g > 0.0 ? 1.0 : 0.0) / static_cast<double>(gains.size());
      sizes.push_back(std::abs(g));
    }
    e.without_best = e.held_out - best;
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    const double most = AcceptanceRules{}.clip * *middle;
    for (const double g : gains) e.clipped += std::clamp(g, -most, most);
  }
  for (const Coordinate& c : suspect.coordinates) {
    const int k = index_of(with, c);
    if (k < 0) continue;
    const double x = with.values[static_cast<std::size_t>(k)];
    if (c.tolerance > 0.0) e.tolerances = std::max(e.tolerances, std::abs(x - c.centre) / c.tolerance);
    // what has no slope is known to its scale at best; a size of less than two is none
    const double near = has_slope(c) ? 1e-6 * (c.high - c.low) : 2.0 * c.scale;
    e.at_bound = e.at_bound || x <= c.low + near || x >= c.high - near;
  }
  return e;
}

namespace {

/// The first rule that is broken, empty if none is.
std::string broken_rule(const Evidence& e, const Suspect& suspect, const AcceptanceRules& rules) {
  if (e.at_bound) return "its parameter stands at a bound";
  if (suspect.toleranced) {
    if (e.delta_bic <= rules.least_bic_toleranced) return "no evidence beyond the stated tolerance";
    return e.tolerances > rules.least_tolerances ? "" : "within what its tolerance leaves open";
  }
  if (e.delta_bic <= rules.least_bic) return e.delta_bic > 0.0 ? "too little evidence" : "no evidence";
  const bool steady = e.held_out > rules.least_held_out && e.without_best > 0.0;
  const bool broad = e.clipped > rules.least_held_out && e.positive_share >= rules.positive_share;
  return steady || broad ? "" : "does not predict the data that were held out";
}

}  // namespace

bool accepted(const Evidence& evidence, const Suspect& suspect, const AcceptanceRules& rules) {
  return broken_rule(evidence, suspect, rules).empty();
}

std::string outcome(const Evidence& evidence, const Suspect& suspect, const AcceptanceRules& rules) {
  const std::string rule = broken_rule(evidence, suspect, rules);
  return rule.empty() ? "named" : rule;
}

}  // namespace wormdrive
