#include "diagnosis/fitting/gap_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/elastic/impact.hpp"
#include "description/build.hpp"
#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "statistics/parallel.hpp"

namespace wormdrive {

namespace {

/// A gap and the bounces of its teeth, found by trying many: the likelihood is too rough to be followed.
class GapSearch {
 public:
  GapSearch(const Evaluation& evaluation, Hypothesis& h, std::size_t gap) : evaluation_(evaluation), h_(h), gap_(gap) {}

  /// Gaps up to a third larger and smaller, with teeth that bounce little and much.
  void coarse() {
    for (const double step : gap_steps)
      for (const double restitution : {0.3, 0.45, 0.6, 0.75}) plan(0.1 * step, {restitution, h_.noise.impact.duration});
    take_best();
  }
  /// Gaps three steps up and down, with restitutions and durations one step up and down.
  void fine(double gap_step, const Restitution& step) {
    const auto [restitution, duration] = h_.noise.impact;
    for (const double by_gap : gap_steps)
      for (const double by_restitution : {-1.0, 0.0, 1.0})
        for (const double by_duration : {-1.0, 0.0, 1.0})
          plan(gap_step * by_gap,
               {restitution + step.restitution * by_restitution, duration + step.duration * by_duration});
    take_best();
  }

 private:
  static constexpr std::array<double, 7> gap_steps{-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0};

  void plan(double larger, const Restitution& impact) {
    Hypothesis trial = h_;
    const Coordinate& gap = h_.free[gap_];
    trial.values[gap_] = std::clamp(h_.values[gap_] * std::exp(larger), gap.low, gap.high);
    trial.noise.impact = {std::clamp(impact.restitution, 0.1, 0.95), std::clamp(impact.duration, 1e-4, 3e-3)};
    trials_.push_back(std::move(trial));
  }
  void take_best() {
    parallel_for(trials_.size(), evaluation_.threads(), [&](std::size_t k) { evaluate(evaluation_, trials_[k]); });
    const auto best = std::min_element(trials_.begin(), trials_.end(),
                                       [](const auto& a, const auto& b) { return a.objective < b.objective; });
    if (best->objective <= h_.objective - rules::least_gap_gain) {
      h_ = std::move(*best);
      fit(evaluation_, h_, 4, 0.5);
    }
    trials_.clear();
  }

  const Evaluation& evaluation_;
  Hypothesis& h_;
  std::size_t gap_;
  std::vector<Hypothesis> trials_{};
};

}  // namespace

std::optional<std::size_t> gap_of(const Hypothesis& h) {
  const int k = index_of(h, "backlash", "gap");
  return k < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(k));
}

void refine_gap(const Evaluation& evaluation, Hypothesis& h) {
  const auto gap = gap_of(h);
  if (!gap) return;
  GapSearch search(evaluation, h, *gap);
  search.fine(0.05, {0.06, 3e-4});
  search.fine(0.025, {0.03, 1.5e-4});
}

void find_gap(const Evaluation& evaluation, Hypothesis& h) {
  const auto gap = gap_of(h);
  if (!gap) return;
  restart_noise(evaluation, h);
  GapSearch(evaluation, h, *gap).coarse();
  restart_noise(evaluation, h);
  refine_gap(evaluation, h);
}

void give_teeth_for_impacts(Scenario& scenario, const Restitution& impact) {
  auto& teeth = std::get<std::optional<ToothCompliance<double>>>(scenario.effects.list);
  const bool has_play = std::get<std::optional<Backlash<double>>>(scenario.effects.list).has_value();
  const bool is_damped = teeth && (teeth->growing_damping || teeth->limited_damping);
  if (is_damped || (!teeth && !has_play)) return;
  const double mass = effective_mass(stated_mesh(scenario), total_gear_inertia(scenario));
  // an impact is half a swing on the teeth
  const double stiffness = teeth ? teeth->stiffness : mass * std::pow(std::numbers::pi / impact.duration, 2);
  double low = 0.0, high = 2.0 * std::sqrt(stiffness * mass);
  for (int k = 0; k < 20; ++k) {  // the restitution falls with the damping
    const double middle = 0.5 * (low + high);
    const double found = restitution({LimitedDamper<double>{stiffness, middle}, 0.0}, mass, 1.0);
    (found > impact.restitution ? low : high) = middle;
  }
  teeth = ToothCompliance<double>{.stiffness = stiffness, .limited_damping = 0.5 * (low + high)};
  scenario.run.solver = SolverKind::cvode;  // the one that follows elastic teeth
}

}  // namespace wormdrive
