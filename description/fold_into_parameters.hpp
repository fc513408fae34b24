#pragma once
#include <optional>
#include <type_traits>

#include "core/effects.hpp"
#include "core/load.hpp"
#include "core/mesh.hpp"

namespace wormdrive {

/// Puts effects that come to nothing but other values of the mesh and the load there, and returns those that are left:
/// a drive with such effects alone is a nominal drive, which solvers may follow by formulas of its own.
template <class Load>
Effects<double> fold_into_parameters(Effects<double> effects, GearMesh<double>& mesh, Load& load) {
  const auto take = [&]<class Effect>(std::optional<Effect>& effect, auto&& into) {
    if (effect) into(*effect);
    effect.reset();
  };
  auto& [list] = effects;
  if (!std::get<std::optional<Agma<double>>>(list))  // which comes first and knows no friction of the mesh's own
    take(std::get<std::optional<MeshFriction<double>>>(list), [&](const auto& teeth) { mesh.mu += teeth.change; });
  if (!mesh.has_teeth) {  // and one inertia
    take(std::get<std::optional<WormInertia<double>>>(list), [&](const auto& more) { mesh.Jg += more.inertia; });
    take(std::get<std::optional<GearInertia<double>>>(list), [&](const auto& more) { mesh.Jg += more.inertia; });
  }
  GravityLoad* arm = nullptr;
  if constexpr (std::is_same_v<Load, GravityLoad>)
    arm = &load;
  else if constexpr (std::is_same_v<Load, SummedLoad>)
    arm = load.lone_arm();
  if (arm != nullptr) {
    take(std::get<std::optional<LoadMagnitude<double>>>(list),
         [&](const auto& magnitude) { arm->amplitude += magnitude.share * arm->amplitude; });
    take(std::get<std::optional<LoadAngle<double>>>(list), [&](const auto& angle) { arm->offset += angle.shift; });
  }
  return effects;
}

}  // namespace wormdrive
