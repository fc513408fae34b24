// What a run of a prepared scenario costs from C++, beside which bench/python_overhead.py puts the same from Python:
// prepared_run SCENARIO... CPU time, rows kept in memory.
#include <algorithm>

#include <fmt/format.h>

#include "simulation/load_scenario.hpp"
#include "simulation/run_scenario.hpp"
#include "statistics/cpu_time.hpp"

using namespace wormdrive;

namespace {

/// Median over rounds of so many runs each [s].
double run_time(const Scenario& scenario, int repetitions) {
  std::vector<double> rounds;
  for (int round = 0; round < 7; ++round) {
    const double begin = cpu_time();
    for (int k = 0; k < repetitions; ++k) {
      Trajectory trajectory;
      std::vector<ControlRecord> samples;
      run_scenario(scenario,
                   {.rows =
                        [&](Trajectory part) {
                          trajectory.rows.insert(trajectory.rows.end(), part.rows.begin(), part.rows.end());
                          trajectory.events.insert(trajectory.events.end(), part.events.begin(), part.events.end());
                        },
                    .samples = [&](const auto& part) { samples.insert(samples.end(), part.begin(), part.end()); }});
    }
    rounds.push_back((cpu_time() - begin) / repetitions);
  }
  std::nth_element(rounds.begin(), rounds.begin() + 3, rounds.end());
  return rounds[3];
}

}  // namespace

int main(int argc, char** argv) {
  const Scenario rest = parse_scenario(
      "[mesh]\nkind = \"none\"\ninertia_kgm2 = 1\n[effect.gear_coulomb]\ntorque_Nm = 1\n[run]\nduration_s = 1\n"
      "report_interval_s = 1\nsolver = \"taylor\"\n",
      "rest", {}, Purpose::run);
  fmt::print("a run of nothing: {:.1f} us\n", 1e6 * run_time(rest, 2000));
  for (int k = 1; k < argc; ++k)
    fmt::print("{}: {:.2f} ms\n", argv[k], 1e3 * run_time(load_scenario(argv[k], {}, Purpose::run), 3));
}
