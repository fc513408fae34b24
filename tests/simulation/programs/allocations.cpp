// A step allocates nothing, alone or together, whatever the solver and whatever happens in it. A program of its own: it
// counts what the whole process allocates. Prints one line per fault; exit status 1 if there is any.
#include <cstdlib>
#include <random>

#include <fmt/format.h>

#include "simulation/stepping/stepped_drives.hpp"
#include "tests/simulation/programs/stepped_gear.hpp"

using namespace wormdrive;
using namespace wormdrive::test;

namespace {

long events_of(const SteppedDrives& drives) {
  long all = 0;
  for (std::size_t k = 0; k < drives.size(); ++k)
    for (const long count : drives.events(k)) all += count;
  return all;
}

/// Steps drives under torques that reverse, and counts what each step allocates. The first third is left out: solvers
/// record the equations of a mode when they meet it first, and torques behind a delay take their place.
int faults(const char* what, std::size_t count, int steps, const std::vector<std::string>& overrides) {
  SteppedDrives drives(gears(count, overrides));
  std::vector<double> torques(count, 0.05);
  std::mt19937 random(1);
  const int first = steps / 3;
  int faulty = 0;
  for (int step = 0; step < steps; ++step) {
    if (step > 0 && step % 20 == 0)
      for (double& torque : torques) torque = 0.02 * static_cast<double>(static_cast<int>(random() % 7) - 3);
    const long before = allocations;
    drives.step(torques, 1e-3);
    const long allocated = allocations - before;
    if (step >= first && allocated > 0 && ++faulty == 1)
      fmt::print(stderr, "{}: step {} allocates {} times\n", what, step, allocated);
  }
  const long events = events_of(drives);
  if (events < 10) {
    fmt::print(stderr, "{}: only {} events: this shows nothing\n", what, events);
    ++faulty;
  }
  fmt::print("{}: {} steps, {} of them allocate; {} events\n", what, steps - first, faulty, events);
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
  all += faults("with a delay", 2, 600, {taylor, "effect.actuator_delay.delay_s=0.0035"});
  all += faults("nominal, by CVODE", 1, 600, {});
  all += faults("elastic teeth", 1, 200,
                {"effect.tooth_compliance.stiffness_N_per_m=1e6", "effect.tooth_compliance.damping_s_per_m=300"});
  return all > 0 ? EXIT_FAILURE : EXIT_SUCCESS;
}
