#pragma once
#include <numbers>
#include <optional>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "core/elastic_teeth.hpp"
#include "scenarios/scenario.hpp"

namespace wormdrive {

/// What the bounds of an effect that makes the teeth elastic cannot say; empty if nothing speaks against it.
inline std::string teeth_refusal(const ToothCompliance<double>& teeth, const Scenario& scenario) {
  if (!std::holds_alternative<MeshParameters<double>>(scenario.mesh)) return "needs teeth, and mesh.kind is \"none\"";
  if (teeth.growing_damping && teeth.limited_damping)
    return "states damping_s_per_m along with damping_Ns_per_m; keep one, the law of Hunt and Crossley or the limited "
           "damper";
  if (!teeth.growing_damping && !teeth.limited_damping)
    return "states no damping; add damping_s_per_m (law of Hunt and Crossley) or damping_Ns_per_m (limited damper), 0 "
           "for none";
  return "";
}
/// The gap is less than the pitch of the gear's teeth, which is largest for a worm with one start: 2 pi / i.
inline std::string teeth_refusal(const Backlash<double>& backlash, const Scenario& scenario) {
  const auto* const mesh = std::get_if<MeshParameters<double>>(&scenario.mesh);
  if (!mesh) return "needs teeth, and mesh.kind is \"none\"";
  if (!has_elastic_teeth(scenario.effects))
    return "needs teeth that yield where they meet; add [effect.tooth_compliance] with stiffness_N_per_m and "
           "damping_s_per_m";
  if (const double pitch = 2.0 * std::numbers::pi / mesh->i; backlash.gap >= pitch)
    return fmt::format(
        "has a gap of {:.6g} deg, which must be less than the pitch of the gear's teeth, {:.6g} deg (360 "
        "deg / ratio)",
        backlash.gap / unit::degree, pitch / unit::degree);
  return "";
}

}  // namespace wormdrive
