// A step in which no event happens allocates nothing, alone or together, whatever the solver. (A motor with a delay
// keeps the torques on their way in a queue, which allocates now and then.) A program of its own: it counts what the
// whole process allocates. Prints one line per fault; exit status 1 if there is any.
#include <cstdlib>
#include <random>

#include <fmt/format.h>

#include "description/toml/parse_scenario.hpp"
#include "simulation/stepping/stepped_drives.hpp"
#include "tests/simulation/programs/stepped_gear.hpp"

using namespace wormdrive;

namespace {

long events_of(const SteppedDrives& drives) {
  long all = 0;
  for (std::size_t k = 0; k < drives.size(); ++k)
    for (const long count : drives.events(k)) all += count;
  return all;
}

/// Steps drives under torques that reverse, and compares each step's events with what it allocates. The first steps are
/// left out: solvers make their first.
int faults(const char* what, std::size_t count, int steps, const std::vector<std::string>& overrides) {
  std::vector<Scenario> scenarios;
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<std::string> own = overrides;
    own.push_back(fmt::format("mesh.friction={}", 0.2 + 0.05 * static_cast<double>(k) / static_cast<double>(count)));
    scenarios.push_back(parse_scenario(gear, "gear", own, Purpose::run));
  }
  SteppedDrives drives(scenarios);
  std::vector<double> torques(count, 0.05);
  std::mt19937 random(1);
  constexpr int first = 10;
  int quiet = 0, faulty = 0;
  long seen = 0;
  for (int step = 0; step < steps; ++step) {
    if (step >= first && step % 20 == 0)
      for (double& torque : torques) torque = 0.02 * static_cast<double>(static_cast<int>(random() % 7) - 3);
    const long before = allocations;
    drives.step(torques, 1e-3);
    const long allocated = allocations - before, events = events_of(drives);
    if (events == seen && step >= first) {
      ++quiet;
      if (allocated > 0 && ++faulty == 1)
        fmt::print(stderr, "{}: step {} has no event and allocates {} times\n", what, step, allocated);
    }
    seen = events;
  }
  if (quiet < steps / 4 || seen == 0) {
    fmt::print(stderr, "{}: only {} of {} steps without an event, {} events: this shows nothing\n", what, quiet, steps,
               seen);
    ++faulty;
  }
  fmt::print("{}: {} steps without an event, {} of them allocate; {} events\n", what, quiet, faulty, seen);
  return faulty;
}

}  // namespace

int main() {
  const std::string taylor = "run.solver=taylor";
  int all = faults("nominal, in lanes", 8, 600, {taylor});
  all += faults("with a Stribeck curve and bearings", 2, 600,
                {taylor, "effect.stribeck.drop=0.05", "effect.stribeck.speed_m_per_s=0.05",
                 "effect.worm_coulomb.torque_Nm=0.003", "effect.gear_viscous.coefficient_Nms_per_rad=0.001"});
  all += faults("with a lag", 2, 600, {taylor, "effect.actuator_lag.time_constant_s=0.01"});
  all += faults("nominal, by CVODE", 1, 300, {});
  return all > 0 ? EXIT_FAILURE : EXIT_SUCCESS;
}
