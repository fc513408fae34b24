#include "simulation/operating_range.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "description/build.hpp"
#include "description/rejection.hpp"
#include "description/tables.hpp"
#include "events/simulation_failure.hpp"
#include "simulation/run_scenario.hpp"

namespace wormdrive {
namespace {

/// Sum of the amplitudes of all arms [N m].
double arm_amplitude(const Scenario& scenario) {
  double amplitude = 0.0;
  for_each_table(scenario, [&](const TablePlace&, const auto& table) {
    if constexpr (requires { table.torque_amplitude(); }) amplitude += std::abs(table.torque_amplitude());
  });
  return amplitude;
}

}  // namespace

OperatingRange operating_range(const Scenario& scenario) {
  double speed = 0.0, load = 0.0, motor = 0.0;
  const auto take = [&](const Trajectory& part) {
    for (const Row& row : part.rows) {
      speed = std::max(speed, std::abs(row.at.omega_g));
      load = std::max(load, std::abs(row.at.tau_l));
      motor = std::max(motor, std::abs(row.at.tau_m));
    }
  };
  if (scenario.run.duration > 0.0 && !why_it_cannot_run(scenario)) try {
      run_scenario(scenario, {.rows = take});
    } catch (const SimulationFailure&) {  // up to there it ran
    }
  const double ratio = make_mesh(scenario).i;
  constexpr double room = 1.5;
  load = room * std::max(load, arm_amplitude(scenario));
  if (speed == 0.0) speed = 2.0 * std::numbers::pi;
  if (load == 0.0) load = motor > 0.0 ? motor * ratio : 1.0;
  return {speed * ratio, load};
}

}  // namespace wormdrive
