// How many steps a second one core makes of drives that are stepped, alone and together, at which error, and how
// often it allocates memory meanwhile. The reference is CVODE at a relative tolerance of 1e-13 under the same torques.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include <fmt/format.h>

#include "simulation/stepping/stepped_drives.hpp"
#include "statistics/cpu_time.hpp"
#include "tests/simulation/programs/stepped_gear.hpp"

using namespace wormdrive;
using namespace wormdrive::test;

namespace {

/// Torques that hold for twenty steps, as of an agent that acts at 50 Hz on a drive that is stepped at 1 kHz.
class Agent {
 public:
  Agent(std::size_t count, bool reverses) : torques_(count, 0.05), reverses_(reverses) {}
  const std::vector<double>& torques(int step) {
    if (reverses_ && step % 20 == 0)
      for (double& torque : torques_) torque = 0.02 * static_cast<double>(static_cast<int>(random_() % 7) - 3);
    return torques_;
  }

 private:
  std::vector<double> torques_;
  bool reverses_;
  std::mt19937 random_{1};
};

void report(const char* what, std::size_t count, int steps, bool reverses, const std::vector<std::string>& overrides) {
  constexpr double dt = 1e-3;
  const std::vector<Scenario> scenarios = gears(count, overrides);
  SteppedDrives drives(scenarios);
  std::vector<double> times;
  long allocated = 0;
  for (int round = 0; round < 5; ++round) {
    drives.reset();
    Agent agent(count, reverses);
    const long before = allocations;
    const double begin = cpu_time();
    for (int step = 0; step < steps; ++step) drives.step(agent.torques(step), dt);
    times.push_back(cpu_time() - begin);
    allocated = allocations - before;
  }
  std::sort(times.begin(), times.end());
  long events = 0;
  double error = 0.0;
  for (std::size_t k = 0; k < count; ++k)
    for (const long n : drives.events(k)) events += n;
  for (std::size_t k = 0; k < count; k += std::max<std::size_t>(1, count / 10)) {
    Scenario exact = scenarios[k];
    exact.run.solver = SolverKind::cvode;
    exact.run.relative_tolerance = 1e-13;
    exact.run.absolute_tolerance = 1e-15;
    const auto judge = make_stepped_drive(exact);
    Agent agent(count, reverses);
    for (int step = 0; step < steps; ++step) judge->step(agent.torques(step)[k], dt);
    error = std::max(error, std::abs(judge->place().theta_g - drives.gear_angle()[k]));
  }
  const double all = static_cast<double>(count) * steps;
  fmt::print("| {} | {} | {} | {:.3g} | {:.1e} | {:.2g} | {:.2g} |\n", what, count,
             drives.in_lanes() ? "lanes" : "alone", all / times[2], error, static_cast<double>(events) / all,
             static_cast<double>(allocated) / all);
}

}  // namespace

int main() {
  fmt::print("Steps of 1 ms, CPU time of one core, median of 5.\n\n");
  fmt::print(
      "| drives | count | how | steps per second | error of the angle [rad] | events per step | allocations per step "
      "|\n");
  fmt::print("|---|---|---|---|---|---|---|\n");
  const std::string taylor = "run.solver=taylor";
  report("nominal, always moving", 1000, 1000, false, {taylor});
  report("nominal, torque reversed or off at 50 Hz", 1000, 1000, true, {taylor});
  report("nominal, torque reversed or off at 50 Hz", 1, 20000, true, {taylor});
  report("with a Stribeck curve and bearings", 100, 1000, true,
         {taylor, "effect.stribeck.drop=0.05", "effect.stribeck.speed_m_per_s=0.05",
          "effect.worm_coulomb.torque_Nm=0.003", "effect.gear_viscous.coefficient_Nms_per_rad=0.001"});
  report("nominal, by CVODE", 10, 1000, true, {});
  report("elastic teeth, by CVODE", 1, 400, true,
         {"effect.tooth_compliance.stiffness_N_per_m=1e6", "effect.tooth_compliance.damping_s_per_m=300"});
}
