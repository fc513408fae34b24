#include "diagnosis/fitting/stepwise.hpp"

#include <algorithm>
#include <cmath>

namespace wormdrive {

bool has_slope(const Coordinate& coordinate) { return !coordinate.stepwise; }

bool search_steps(const Evaluation& evaluation, Hypothesis& h) {
  const double before = h.objective;
  for (std::size_t k = 0; k < h.free.size(); ++k) {
    if (has_slope(h.free[k])) continue;
    const double low = h.free[k].low, high = h.free[k].high;  // h, and its list with it, is replaced below
    const auto better_by = [&](double factor) {
      Hypothesis trial = h;
      trial.values[k] = std::clamp(factor * h.values[k], low, high);
      if (!evaluate(evaluation, trial) || trial.objective >= h.objective) return false;
      h = std::move(trial);
      return true;
    };
    for (const double share : {0.4, 0.2, 0.1, 0.05, 0.025})
      while (better_by(1.0 + share) || better_by(1.0 - share)) {
      }
  }
  return h.objective < before;
}

double spread_of_steps(const Evaluation& evaluation, const Hypothesis& h, std::size_t k) {
  constexpr double quantile = 1.96, fall = 0.5 * quantile * quantile;  // [nats] at the ends of a 95 % interval
  const Coordinate& c = h.free[k];
  double width = 0.0;
  for (const double side : {1.0, -1.0}) {
    double distance = 0.25 * c.scale;
    for (bool open = true; open; distance *= 1.5) {
      Hypothesis there = h;
      there.values[k] = std::clamp(h.values[k] + side * distance, c.low, c.high);
      open = evaluate(evaluation, there) && there.objective < h.objective + fall && there.values[k] > c.low &&
             there.values[k] < c.high;
      if (!open) width += std::abs(there.values[k] - h.values[k]);
    }
  }
  return std::max(c.scale, 0.5 * width / quantile);
}

}  // namespace wormdrive
