#include "diagnosis/verdict/extended_scenario.hpp"

#include <fmt/format.h>

#include "core/elastic/elastic_teeth.hpp"
#include "description/rejection.hpp"
#include "diagnosis/fitting/gap_search.hpp"

namespace wormdrive {
namespace {

/// The predictor follows rigid teeth, beside which these effects act; elastic ones replace them.
void leave_out_what_elastic_teeth_exclude(Scenario& scenario, std::vector<std::string>& remarks) {
  if (!has_elastic_teeth(scenario.effects)) return;
  scenario.effects.for_each([&]<class Effect>(std::optional<Effect>& effect) {
    if constexpr (requires { Effect::excludes; })
      for (const Exclusion& exclusion : Effect::excludes)
        if (effect && exclusion.id == ToothCompliance<double>::id) {
          effect.reset();
          remarks.push_back(fmt::format("the extended scenario leaves {} out: {}", Effect::id, exclusion.why));
        }
  });
}

/// What friction drifts to behind the end of the recording is not known, and in a long run comes to nothing possible.
void end_where_a_drift_is_known(Scenario& scenario, std::vector<std::string>& remarks) {
  const auto& drift = std::get<std::optional<FrictionDrift<double>>>(scenario.effects.list);
  if (!drift || scenario.run.duration <= drift->time || !why_it_cannot_move(scenario)) return;
  scenario.run.duration = drift->time;
  remarks.push_back(fmt::format(
      "the extended scenario ends at {:.6g} s: there the recording does, and what its friction_drift goes on to is not "
      "known",
      drift->time));
}

}  // namespace

Scenario extended_scenario(Scenario stated, const Effects<double>& found, const Restitution& impact,
                           std::vector<std::string>& remarks) {
  stated.effects = found;
  give_teeth_for_impacts(stated, impact);
  leave_out_what_elastic_teeth_exclude(stated, remarks);
  end_where_a_drift_is_known(stated, remarks);
  return stated;
}

}  // namespace wormdrive
