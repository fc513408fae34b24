#include "sweep/rare/rare_event.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "description/diagnostics.hpp"
#include "sweep/rare/importance_sampling.hpp"
#include "sweep/study/reject_without_distributions.hpp"

namespace wormdrive {

const Threshold& limit_of(const Study& study, const std::string& path, const std::string& metric) {
  reject_without_distributions(study, path, "an estimate of rare misses needs distributions");
  if (study.thresholds.empty())
    reject({path}, "states no limit; a [[threshold]] names the metric, and above_UNIT or below_UNIT the limit");
  if (metric.empty()) return study.thresholds.front();
  const auto found = std::find_if(study.thresholds.begin(), study.thresholds.end(),
                                  [&](const Threshold& t) { return t.metric == metric; });
  if (found == study.thresholds.end())
    reject({path}, fmt::format("states no [[threshold]] of the metric '{}'", metric));
  return *found;
}

std::uint64_t most_runs(const Study& study, const RareSettings& settings) {
  constexpr std::uint64_t median = 1, likely = 1;
  return most_evaluations(SubsetSettings{.per_level = settings.per_level}) + median +
         most_evaluations_for_design_point(study.parameters.size()) + likely + settings.samples;
}

double RareEvent::plain_trials() const {
  const RareEstimate& p = subset.estimate;
  return (1.0 - p.probability) / (p.probability * p.variation * p.variation);
}

RareEvent estimate_rare_event(const Study& study, const std::string& path, const RareSettings& settings) {
  const std::size_t dimensions = study.parameters.size();
  RareEvent event;
  event.threshold = limit_of(study, path, settings.metric);
  DriveLimit limit(study, event.threshold, settings.threads, settings.kept);
  const LimitState state = [&](const auto& points, const auto& noise) { return limit(points, noise); };
  try {
    event.subset = subset_simulation(state, dimensions, {.per_level = settings.per_level, .seed = study.seed});
  } catch (const PlateauFault& fault) {
    reject({path},
           fmt::format("{} {}: none misses it, or the metric jumps to it; subset simulation needs one that gradually "
                       "approaches its limit",
                       event.threshold.metric, fault.what()));
  }
  const std::uint64_t next = event.subset.estimate.evaluations;
  const NormalPoint median(dimensions, 0.0);
  event.median_misses = !(state({median}, {next}).front() > 0.0);
  if (event.median_misses) return event;
  event.design = find_design_point(state, dimensions, next);
  event.likely = limit.trial(event.design.point, next);
  event.importance = importance_sampling(state, event.design.point,
                                         {.samples = settings.samples, .seed = study.seed, .first = next + 1});
  return event;
}

}  // namespace wormdrive
