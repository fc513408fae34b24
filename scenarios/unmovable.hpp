#pragma once
#include <optional>
#include <string>
#include <variant>

#include <fmt/format.h>

#include "core/elastic_teeth.hpp"
#include "scenarios/build.hpp"

namespace wormdrive {

/// Why no unique motion of a scenario's drive exists until its end, or nothing: beyond mu_g the worm brakes itself, for
/// C2 has passed through infinity; without eq. 17 the rigid drive would jam.
inline std::optional<std::string> why_it_cannot_move(const Scenario& scenario) {
  const auto* const parameters = std::get_if<MeshParameters<double>>(&scenario.mesh);
  if (!parameters) return std::nullopt;
  GearMesh<double> mesh = make_mesh(scenario);
  const double stated = parameters->mu;
  const FrictionRange range = scenario.effects.friction_range({stated, stated}, scenario.run.duration);
  if (range.low < 0.0)
    return fmt::format("mesh.friction = {} may fall to {:.6g} with its effects; friction must be at least 0", stated,
                       range.low);
  if (has_elastic_teeth(scenario.effects)) return std::nullopt;  // which have one motion for every friction
  mesh.mu = range.high;
  std::string friction = fmt::format("mesh.friction = {}", stated);
  if (mesh.mu != stated) friction += fmt::format(", which may rise to {:.6g} with its effects,", mesh.mu);
  if (mesh.mu >= mesh.mu_g())
    return fmt::format(
        "{} is not below mu_g = {:.6g} (cos(phi_n)/tan(lambda)): the worm would lock itself; only "
        "elastic teeth, [effect.tooth_compliance], can follow it",
        friction, mesh.mu_g());
  const double slope = scenario.effects.least_slope(), Jw_i = mesh.Jw * mesh.i * slope * slope;
  const double Jg = total_gear_inertia(scenario), surface = Jw_i / Jg;
  const std::string limit =
      slope < 1.0 ? fmt::format("-Jw i k^2/Jg where the worm is slowest, k = {:.6g},", slope) : "-Jw i/Jg";
  if (mesh.C1() > -surface) return std::nullopt;
  return fmt::format(
      "{} violates eq. 17, C1 > -Jw i/Jg: C1 = {:.6g}, {} = {:.6g} with Jg = {:.6g} kg m^2; the rigid "
      "drive would jam. Lower the friction, raise worm_inertia_kgm2, lower the gear-side inertia below "
      "{:.6g} kg m^2, or add [effect.tooth_compliance]: elastic teeth can jam",
      friction, mesh.C1(), limit, -surface, Jg, -Jw_i / mesh.C1());
}

}  // namespace wormdrive
