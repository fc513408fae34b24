#pragma once
#include <limits>
#include <utility>
#include <variant>

#include "core/worm_drive.hpp"
#include "description/fold_into_parameters.hpp"
#include "description/scenario.hpp"

namespace wormdrive {

/// The mesh as a scenario states it, with teeth or without; effects do not show in it.
inline GearMesh<double> stated_mesh(const Scenario& scenario) {
  if (const auto* worm = std::get_if<MeshParameters<double>>(&scenario.mesh)) return GearMesh<double>(*worm);
  return GearMesh<double>::without_teeth(std::get<SingleInertia<double>>(scenario.mesh).J);
}

/// Builds the drive of a scenario with other effects and another motor torque. Of the effects it has those that are not
/// taken up by mesh and load; without their states, what has a state follows at once.
template <bool with_states = false, class Stated>
auto make_drive(const Scenario& scenario, const Stated& stated_load, const Effects<double>& effects,
                const Signal& motor) {
  auto load = make_load(stated_load);
  GearMesh<double> mesh = stated_mesh(scenario);
  const Effects<double> left = fold_into_parameters(effects, mesh, load);
  return WormDrive<double, decltype(load), with_states>(mesh, load, left, motor);
}

/// The same with whatever load the scenario states, in the one form that all of them have.
template <bool with_states = false>
auto make_drive(const Scenario& scenario, const Effects<double>& effects, const Signal& motor) {
  return make_drive<with_states>(scenario, sum_of(scenario.load), effects, motor);
}
/// The drive of a scenario.
template <bool with_states = false>
auto make_drive(const Scenario& scenario) {
  return make_drive<with_states>(scenario, scenario.effects, scenario.motor);
}

/// Calls use(drive) with the drive of a scenario that has the load's own form, for runs: solvers have formulas for
/// some.
template <class Use>
decltype(auto) with_drive_for_runs(const Scenario& scenario, Use&& use) {
  return std::visit(
      [&](const auto& load) {
        auto drive = make_drive(scenario, load, scenario.effects, scenario.motor);
        return use(drive);
      },
      scenario.load);
}

/// The mesh of a scenario with what its effects add to the inertias and, at the start and after a long rest, to the
/// friction; with a direction, as the drive starts to move in it.
inline GearMesh<double> make_mesh(const Scenario& scenario, Motion motion = Motion::stuck) {
  const auto drive = make_drive(scenario);
  GearMesh<double> mesh = drive.mesh();
  Moment<double> at = drive.moment(0.0, scenario.initial.theta_g, 0.0);
  at.rest = std::numeric_limits<double>::infinity();
  if (mesh.has_teeth) mesh.mu = drive.friction(at, motion);
  return mesh;
}

/// Inertia of the gear side with the load's own and what effects add [kg m^2]; without teeth all that moves.
inline double total_gear_inertia(const Scenario& scenario) { return make_drive(scenario).Jg(); }
/// The same at the angle at which it is greatest.
inline double greatest_gear_inertia(const Scenario& scenario) {
  const double total = total_gear_inertia(scenario);
  if (scenario.effects.twisting_coupling()) return total;  // what depends on the angle is behind it
  return through(scenario.effects.list, total, [](const auto& e, double sum) -> decltype(e.greatest_inertia()) {
    return sum + e.greatest_inertia();
  });
}

}  // namespace wormdrive
