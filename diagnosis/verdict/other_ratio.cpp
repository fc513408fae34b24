#include "diagnosis/verdict/other_ratio.hpp"

#include <cmath>

#include <fmt/format.h>

#include "diagnosis/rules/verdict.hpp"

namespace wormdrive {

std::optional<std::string> other_ratio(const Diagnosis& d, const Scenario& scenario, bool has_worm_encoder) {
  const auto* const mesh = std::get_if<MeshParameters<double>>(&scenario.mesh);
  if (!mesh || has_worm_encoder) return std::nullopt;
  for (const EstimatedEffect& cause : d.causes) {
    if (cause.effect != WormInertia<double>::id) continue;
    const double ratio = mesh->i * (1.0 + cause.parameters.front().value / mesh->Jw);
    if (std::abs(ratio - mesh->i) < rules::least_other_ratio) continue;
    return fmt::format(
        "a ratio of {:.3g} in place of {:g} would do the same as this inertia of the worm: count how "
        "often the worm turns for one turn of the gear",
        ratio, mesh->i);
  }
  return std::nullopt;
}

}  // namespace wormdrive
