#include "diagnosis/inference/bounds.hpp"

#include <algorithm>
#include <utility>

#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/fitting/laws.hpp"
#include "diagnosis/fitting/stepwise.hpp"

namespace wormdrive {

int bound_met(const Coordinate& c, double value) {
  // what has no slope is known to its scale at best; a size of less than two is none
  const double near = has_slope(c) ? 1e-6 * (c.high - c.low) : 2.0 * c.scale;
  return value >= c.high - near ? 1 : value <= c.low + near ? -1 : 0;
}

namespace {

/// Twice a lower bound, half an upper one; a quarter of the range where these are not within it.
double within(const Coordinate& c, int bound) {
  const double inside = bound < 0 ? 2.0 * c.low : 0.5 * c.high;
  if (inside > c.low && inside < c.high) return inside;
  const double quarter = 0.25 * (c.high - c.low);
  return bound < 0 ? c.low + quarter : c.high - quarter;
}

}  // namespace

void leave_bounds(const Evaluation& evaluation, Hypothesis& h, const Candidate& candidate) {
  const auto bound_of = [&](const Coordinate& c) {
    const int k = index_of(h, c);
    const int bound = k < 0 ? 0 : bound_met(c, h.values[static_cast<std::size_t>(k)]);
    return bound < 0 && c.none_at_low ? 0 : bound;
  };
  if (std::ranges::none_of(candidate.coordinates, bound_of)) return;
  try_other_laws(evaluation, h, candidate);  // with more noise they had been alike
  for (const Coordinate& c : candidate.coordinates) {
    const int bound = bound_of(c);
    if (bound == 0) continue;
    Hypothesis trial = h;
    trial.values[static_cast<std::size_t>(index_of(h, c))] = within(c, bound);
    fit(evaluation, trial, 6);
    if (trial.objective < h.objective) h = std::move(trial);
  }
}

}  // namespace wormdrive
