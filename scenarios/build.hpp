#pragma once
#include <variant>

#include "core/worm_drive.hpp"
#include "scenarios/scenario.hpp"

namespace wormdrive {

/// The mesh of a scenario, with teeth or without.
inline GearMesh<double> make_mesh(const Scenario& scenario) {
  if (const auto* worm = std::get_if<MeshParameters<double>>(&scenario.mesh)) return GearMesh<double>(*worm);
  return GearMesh<double>::without_teeth(std::get<SingleInertia>(scenario.mesh).J);
}

/// Inertia of the gear side with the load's own [kg m^2].
inline double total_gear_inertia(const Scenario& scenario) {
  return make_mesh(scenario).Jg + std::visit([](const auto& load) { return make_load(load).inertia(); }, scenario.load);
}

/// Builds the concrete drive of a scenario and calls use(drive): its load's type is known from here on.
template <class Use>
decltype(auto) with_drive(const Scenario& scenario, Use&& use) {
  return std::visit(
      [&](const auto& parameters) {
        using Load = decltype(make_load(parameters));
        WormDrive<double, Load> drive(make_mesh(scenario), make_load(parameters), scenario.effects, scenario.motor);
        return use(drive);
      },
      scenario.load);
}

}  // namespace wormdrive
