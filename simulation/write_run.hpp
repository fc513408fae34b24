#pragma once
#include <string>

#include <fmt/format.h>

#include "core/elastic/elastic_teeth.hpp"
#include "core/states/winding.hpp"
#include "description/build.hpp"
#include "output/run_file.hpp"

namespace wormdrive {

/// "cvode (BDF, rtol 1e-12)", "taylor (rtol 1e-12)"
inline std::string describe_solver(const RunSettings& run) {
  if (run.solver == SolverKind::taylor) return fmt::format("taylor (rtol {:g})", run.relative_tolerance);
  return fmt::format("cvode ({}, rtol {:g})", run.method == Method::bdf ? "BDF" : "Adams", run.relative_tolerance);
}

/// What the run of a scenario will show.
inline RunContents contents_of(const Scenario& scenario) {
  return {scenario.control.has_value(), has_elastic_teeth(scenario.effects), dc_motor(scenario.effects).has_value()};
}

/// Writes the constants of a drive that readers of a run need beside its columns: surface and ratio, if it has a gear.
inline void write_drive(hid_t file, const Scenario& scenario) {
  const GearMesh<double> mesh = make_mesh(scenario);
  if (!mesh.has_teeth) return;
  write_attribute(file, "surface", mesh.Jw * mesh.i / total_gear_inertia(scenario));
  write_attribute(file, "ratio", mesh.i);
}

}  // namespace wormdrive
