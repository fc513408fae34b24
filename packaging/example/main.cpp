// Runs a scenario and prints its events: my_simulator SCENARIO
#include <fmt/format.h>

#include "simulation/load_scenario.hpp"
#include "simulation/run_scenario.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: my_simulator SCENARIO\n");
    return 2;
  }
  try {
    const wormdrive::Scenario scenario = wormdrive::load_scenario(argv[1], {}, wormdrive::Purpose::run);
    const wormdrive::Trajectory run = wormdrive::simulate_scenario(scenario);
    fmt::print("{}\n", scenario.title);
    for (const wormdrive::Event& event : run.events)
      fmt::print("  {:10.6f} s  {}\n", event.t, wormdrive::name(event.kind()));
    fmt::print("{} events; at the end the gear is at {:.6f} rad\n", run.events.size(), run.rows.back().at.theta_g);
  } catch (const std::exception& fault) {
    fmt::print(stderr, "{}\n", fault.what());
    return 1;
  }
}
