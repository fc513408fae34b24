#include "diagnosis/experiment/next_step.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/experiment/experiment.hpp"
#include "diagnosis/rules/evidence.hpp"
#include "diagnosis/rules/verdict.hpp"

namespace wormdrive {

namespace {

/// Candidates with these effects, in their order; an effect that is no candidate of its own is left out.
std::vector<Candidate> with_effects(const std::vector<Candidate>& all, const std::vector<std::string>& effects) {
  std::vector<Candidate> found;
  for (const std::string& effect : effects)
    for (const Candidate& candidate : all)
      if (candidate.effect == effect) found.push_back(candidate);
  return found;
}

/// Effects of the drive with much evidence of which none is believed, the best first.
std::vector<std::string> best_rejected(const Diagnosis& d, const std::vector<Candidate>& all) {
  std::vector<std::string> best;
  for (const RankedCandidate& c : d.ranking) {
    const auto candidate =
        std::find_if(all.begin(), all.end(), [&](const Candidate& x) { return x.effect == c.effect.effect; });
    if (best.size() < rules::most_contenders && c.delta_bic > rules::least_bic && candidate != all.end() &&
        !candidate->of_recording && !c.effect.parameters.empty())
      best.push_back(c.effect.effect);
  }
  return best;
}

/// The size of an effect as it was found, beside others or alone.
double size_of(const Diagnosis& d, std::string_view effect) {
  for (const EstimatedEffect& cause : d.causes)
    if (cause.effect == effect) return std::abs(cause.parameters.front().value);
  for (const RankedCandidate& c : d.ranking)
    if (c.effect.effect == effect) return std::abs(c.effect.parameters.front().value);
  return 0.0;
}

/// What to record where no candidate is worth a motion of its own, by what the structure that is left depends on.
std::string advice(const Remainder& left) {
  struct Advice {
    std::string_view axis, record;
  };
  constexpr Advice list[] = {
      {"angle and direction",
       "the whole way slowly, both ways and at two speeds: what belongs to an angle stays there"},
      {"one angle", "slow passes over that angle, both ways and under two loads"},
      {"speed", "constant speeds, both ways, from the slowest that runs to the fastest"},
      {"speed and load", "constant speeds under two loads"},
      {"time", "the same motion twice, at once and after a rest: what changes by itself differs"}};
  if (left.frequency > 0.0)
    return fmt::format(
        "record once more with everything switched off that runs beside the drive, and at another speed: "
        "a line that stays at {:.3g} Hz is not the drive's",
        left.frequency);
  const auto known =
      std::find_if(std::begin(list), std::end(list), [&](const Advice& a) { return a.axis == left.axis; });
  return fmt::format("record {}",
                     known != std::end(list)
                         ? known->record
                         : "constant speeds both ways under two loads, and a slow motion over the whole way");
}

}  // namespace

void propose_next_step(Diagnosis& d, const Scenario& scenario, const std::vector<Candidate>& all,
                       const std::vector<Coordinate>& toleranced, const Magnitudes& sizes,
                       const std::vector<PreparedRecording>& recordings, const DiagnosisSettings& settings) {
  const bool unexplained = d.verdict == Verdict::unexplained;
  if (d.verdict != Verdict::ambiguous && !unexplained) return;
  const auto propose = [&](const std::vector<Candidate>& contenders) {
    if (settings.progress) settings.progress("looking for an experiment");
    const double resolution = recordings.front().data.gear_resolution;
    const Question question{scenario,       d.extended,
                            contenders,     size_of(d, contenders.front().effect),
                            toleranced,     sizes,
                            d.noise_torque, resolution > 0.0 ? std::round(2.0 * std::numbers::pi / resolution) : 0.0};
    Experiment found =
        best_experiment(question, allowed_range(scenario, recordings, sizes.load_turns), settings.threads);
    d.experiment = std::move(found.scenario);
    d.experiment_reason = std::move(found.reason);
    return d.experiment.has_value();
  };
  if (unexplained) {
    const bool is_line = !d.remainders.empty() && d.remainders.front().frequency > 0.0;  // which no motion explains
    const std::vector<Candidate> contenders = with_effects(all, best_rejected(d, all));
    if (!is_line && contenders.size() > 1 && propose(contenders)) return;
    if (!d.remainders.empty()) d.experiment_reason = advice(d.remainders.front());
    return;
  }
  for (const std::vector<std::string>& effects : d.classes) {
    const std::vector<Candidate> members = with_effects(all, effects);
    if (members.size() < effects.size()) {  // twins are no candidates of their own
      d.experiment_reason =
          fmt::format("no motion tells {} apart: it takes an index mark for a zero, a time stamp for a delay",
                      fmt::join(effects, " and "));
      continue;
    }
    if (propose(members)) return;
  }
}

}  // namespace wormdrive
