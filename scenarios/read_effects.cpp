#include "scenarios/read_effects.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/elastic_teeth.hpp"
#include "scenarios/build.hpp"
#include "scenarios/read_reference.hpp"

namespace wormdrive {
namespace {

// What the bounds of an effect's fields cannot say; empty if nothing speaks against it.

template <class Effect>
std::string refusal(const Effect&, const Scenario&) {
  return "";
}
std::string refusal(const WormInertia<double>& effect, const Scenario& scenario) {
  const GearMesh<double> mesh = stated_mesh(scenario);
  const bool enough = mesh.has_teeth ? mesh.Jw + effect.inertia > 0.0 : effect.inertia >= 0.0;
  return enough ? "" : fmt::format("leaves no inertia on the worm side: {} + {} kg m^2", mesh.Jw, effect.inertia);
}
std::string refusal(const GearInertia<double>& effect, const Scenario& scenario) {
  const double Jg = stated_mesh(scenario).Jg;
  if (Jg + effect.inertia > 0.0) return "";
  return fmt::format("leaves no inertia on the gear side: {} + {} kg m^2", Jg, effect.inertia);
}
std::string refusal(const BearingAsymmetry<double>& effect, const Scenario& scenario) {
  const auto& dry = std::get<std::optional<WormCoulomb<double>>>(scenario.effects.list);
  const auto& viscous = std::get<std::optional<WormViscous<double>>>(scenario.effects.list);
  if (std::abs(effect.torque) <= (dry ? dry->torque : 0.0) &&
      std::abs(effect.coefficient) <= (viscous ? viscous->coefficient : 0.0))
    return "";
  return "is greater than the friction it belongs to, worm_coulomb or worm_viscous: it would drive the worm";
}
std::string refusal(const ToothCompliance<double>& teeth, const Scenario&) {
  if (teeth.growing_damping && teeth.limited_damping)
    return "states damping_s_per_m along with damping_Ns_per_m; keep one, the law of Hunt and Crossley or the limited "
           "damper";
  if (!teeth.growing_damping && !teeth.limited_damping)
    return "states no damping; add damping_s_per_m (law of Hunt and Crossley) or damping_Ns_per_m (limited damper), 0 "
           "for none";
  return "";
}
/// The gap is less than the pitch of the gear's teeth, which is largest for a worm with one start: 2 pi / i.
std::string refusal(const Backlash<double>& backlash, const Scenario& scenario) {
  if (!has_elastic_teeth(scenario.effects))
    return "needs teeth that yield where they meet; add [effect.tooth_compliance] with stiffness_N_per_m and "
           "damping_s_per_m";
  if (const double pitch = 2.0 * std::numbers::pi / stated_mesh(scenario).i; backlash.gap >= pitch)
    return fmt::format(
        "has a gap of {:.6g} deg, which must be less than the pitch of the gear's teeth, {:.6g} deg (360 "
        "deg / ratio)",
        backlash.gap / unit::degree, pitch / unit::degree);
  return "";
}

/// Why an effect cannot be on along with another one that is; empty if it can.
template <class Effect>
std::string conflict(const Effects<double>& on) {
  std::string why;
  if constexpr (requires { Effect::excludes; })
    on.for_each([&]<class Other>(const std::optional<Other>& other) {
      for (const Exclusion& exclusion : Effect::excludes)
        if (other && Other::id == exclusion.id)
          why = fmt::format("excludes effect.{}: {}; keep one of them", exclusion.id, exclusion.why);
    });
  return why;
}

template <class Effect>
std::string why_not(const Effect& effect, const Scenario& scenario) {
  if (Effect::place == Place::mesh && !stated_mesh(scenario).has_teeth) return "needs teeth, and mesh.kind is \"none\"";
  const std::string refused = refusal(effect, scenario);
  return refused.empty() ? conflict<Effect>(scenario.effects) : refused;
}

}  // namespace

void read_effects(TableReader& root, Scenario& scenario, Purpose purpose) {
  root.section("effect", [&](TableReader& effects) {
    scenario.effects.for_each([&]<class Effect>(std::optional<Effect>& effect) {
      const toml::table* table = effects.table(std::string(Effect::id));
      if (!table) return;
      TableReader reader(table, fmt::format("effect.{}", Effect::id), scenario.axis, root.faults(), effects.where());
      const bool on = reader.truth("on").value_or(true);
      Effect parameters;
      reader.read_fields(parameters);
      if constexpr (requires { parameters.exponent; }) require_whole(reader, "exponent", parameters.exponent);
      reader.finish();
      if (on) effect = parameters;
    });
    if (purpose == Purpose::look || !root.faults().empty()) return;
    scenario.effects.for_each([&]<class Effect>(const std::optional<Effect>& effect) {
      if (!effect) return;
      if (const std::string why = why_not(*effect, scenario); !why.empty())
        effects.fault(std::string(Effect::id), fmt::format("effect.{} {}", Effect::id, why));
    });
  });
}

}  // namespace wormdrive
