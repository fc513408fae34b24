#include "diagnosis/bounces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/impact.hpp"
#include "diagnosis/fit.hpp"
#include "diagnosis/parallel.hpp"
#include "scenarios/build.hpp"

namespace wormdrive {

void fit_bounces(const Evaluation& by, Hypothesis& h, double widest) {
  const auto found =
      std::find_if(h.free.begin(), h.free.end(), [](const Coordinate& c) { return c.effect == "backlash"; });
  if (found == h.free.end()) return;
  const Coordinate gap = *found;
  const auto index = static_cast<std::size_t>(found - h.free.begin());
  for (double width = widest; width >= 0.25; width *= 0.5) {
    std::vector<Hypothesis> trials;
    for (const double by_gap : {-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0})
      for (const double by_restitution : {-1.0, 0.0, 1.0})
        for (const double by_duration : {-1.0, 0.0, 1.0}) {
          Hypothesis trial = h;
          const auto [restitution, duration] = h.noise.bounce;
          trial.values[index] = std::clamp(h.values[index] * std::exp(0.1 * width * by_gap), gap.low, gap.high);
          trial.noise.bounce = {std::clamp(restitution + 0.06 * width * by_restitution, 0.1, 0.95),
                                std::clamp(duration + 3e-4 * width * by_duration, 1e-4, 3e-3)};
          trials.push_back(std::move(trial));
        }
    parallel_for(trials.size(), by.threads(), [&](std::size_t k) { evaluate(by, trials[k]); });
    constexpr double least_gain = 2.0;
    const auto best = std::min_element(trials.begin(), trials.end(),
                                       [](const auto& a, const auto& b) { return a.objective < b.objective; });
    if (best->objective > h.objective - least_gain) continue;
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
  scenario.run.solver = SolverKind::cvode;  // the one that follows elastic teeth
}

}  // namespace wormdrive
