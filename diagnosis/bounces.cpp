#include "diagnosis/bounces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/impact.hpp"
#include "diagnosis/fit.hpp"
#include "diagnosis/parallel.hpp"
#include "scenarios/build.hpp"

namespace wormdrive {

void fit_bounces(const Evaluation& by, Hypothesis& h) {
  const auto found =
      std::find_if(h.free.begin(), h.free.end(), [](const Coordinate& c) { return c.effect == "backlash"; });
  if (found == h.free.end()) return;
  const Coordinate gap = *found;
  const auto index = static_cast<std::size_t>(found - h.free.begin());
  constexpr int rounds = 3;
  constexpr double least_gain = 2.0;
  for (int round = 0; round < rounds; ++round) {
    std::vector<Hypothesis> trials;
    for (const double factor : {0.75, 0.85, 0.92, 0.97, 1.0, 1.03, 1.08, 1.17, 1.3})
      for (const double more : {-0.06, 0.0, 0.06})
        for (const double longer : {-3e-4, 0.0, 3e-4}) {
          Hypothesis trial = h;
          trial.values[index] = std::clamp(factor * h.values[index], gap.low, gap.high);
          trial.noise.bounce = {std::clamp(h.noise.bounce.restitution + more, 0.1, 0.95),
                                std::clamp(h.noise.bounce.duration + longer, 1e-4, 3e-3)};
          trials.push_back(std::move(trial));
        }
    parallel_for(trials.size(), by.threads(), [&](std::size_t k) { evaluate(by, trials[k]); });
    const auto best = std::min_element(trials.begin(), trials.end(),
                                       [](const auto& a, const auto& b) { return a.objective < b.objective; });
    if (best->objective > h.objective - least_gain) return;
    h = std::move(*best);
    fit(by, h, 4, 0.5);
  }
}

void give_teeth_to_bounce(Scenario& scenario, const Bounce& bounce) {
  auto& teeth = std::get<std::optional<ToothCompliance<double>>>(scenario.effects.list);
  const bool has_play = std::get<std::optional<Backlash<double>>>(scenario.effects.list).has_value();
  const bool is_damped = teeth && (teeth->growing_damping || teeth->limited_damping);
  if (is_damped || (!teeth && !has_play)) return;
  const double mass = effective_mass(stated_mesh(scenario), total_gear_inertia(scenario));
  // an impact is half a swing on the teeth
  const double stiffness = teeth ? teeth->stiffness : mass * std::pow(std::numbers::pi / bounce.duration, 2);
  double low = 0.0, high = 2.0 * std::sqrt(stiffness * mass);
  for (int k = 0; k < 20; ++k) {  // the restitution falls with the damping
    const double middle = 0.5 * (low + high);
    const double found = restitution({LimitedDamper<double>{stiffness, middle}, 0.0}, mass, 1.0);
    (found > bounce.restitution ? low : high) = middle;
  }
  teeth = ToothCompliance<double>{.stiffness = stiffness, .limited_damping = 0.5 * (low + high)};
}

}  // namespace wormdrive
