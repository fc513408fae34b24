#pragma once
#include <algorithm>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "core/elastic/elastic_teeth.hpp"
#include "core/states/impact_on_stop.hpp"
#include "core/states/winding.hpp"
#include "description/build.hpp"
#include "output/run_columns.hpp"

namespace wormdrive {

/// "cvode (BDF, rtol 1e-12)", "taylor (rtol 1e-12)"
inline std::string describe_solver(const RunSettings& run) {
  if (run.solver == SolverKind::taylor) return fmt::format("taylor (rtol {:g})", run.relative_tolerance);
  return fmt::format("cvode ({}, rtol {:g})", run.method == Method::bdf ? "BDF" : "Adams", run.relative_tolerance);
}

/// What the run of a scenario will show.
inline RunContents contents_of(const Scenario& scenario) {
  RunContents contents{scenario.control.has_value(), has_elastic_teeth(scenario.effects),
                       dc_motor(scenario.effects).has_value(), hard_stops(scenario.effects).has_value()};
  contents.expected_rows = static_cast<std::uint64_t>(std::min(scenario.run.duration / scenario.run.rows_every(), 1e6));
  scenario.effects.for_each_state([&](std::string_view id, const EffectState& state, std::size_t place) {
    if (!state.meaning.empty()) contents.states.push_back(state_column(id, state, place));
  });
  return contents;
}

/// Writes the constants of a drive that readers of a run need beside its columns, if it has a gear: its ratio, and the
/// slope of the surface where that is one.
inline void write_drive(hid_t file, const Scenario& scenario) {
  const GearMesh<double> mesh = make_mesh(scenario);
  if (!mesh.has_teeth) return;
  if (!scenario.effects.inertia_varies())
    write_attribute(file, "surface", mesh.Jw * mesh.i / total_gear_inertia(scenario));
  write_attribute(file, "ratio", mesh.i);
}

}  // namespace wormdrive
