#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "catch.hpp"
#include "cli/program.hpp"
#include "near_ties/dice.hpp"
#include "scenarios/random_loops.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/run_scenario.hpp"

// Friction that changes within a billionth of the speed that a drive has: just before a stop it rises from nothing.

namespace wormdrive::test::scenarios_narrow_friction {

namespace {

using near_ties::Dice;

/// A drive that swings, against a spring or not, with friction of any shape that changes within a share of its speed.
std::vector<std::string> swing(Dice& dice) {
  const RandomLoop on = draw_loop(dice);
  const double speed = 0.66 * 1.2 / on.T;  // between the teeth [m/s]
  std::vector<std::string> words{
      fmt::format("mesh.worm_inertia_kgm2={}", 2.53e-5 * on.J),
      fmt::format("mesh.gear_inertia_kgm2={}", 7.39e-4 * on.J),
      fmt::format("mesh.friction={}", dice.between(0.08, 0.3)),
      fmt::format("load={{kind=\"constant\",torque_Nm={}}}", 0.01 * on.torque() * dice.between(-1.0, 1.0)),
      fmt::format("motor.torque={{kind=\"sinusoid\",amplitude_Nm={},frequency_Hz={}}}",
                  on.torque() * dice.between(0.02, 0.06), 5.0 / on.T),
      fmt::format("effect.stribeck={{drop={},speed_m_per_s={},exponent={},tail={}}}", dice.between(-0.05, 0.05),
                  speed * dice.decades(1e-9, 1.0), 1 + dice.below(4), dice.below(2)),
      fmt::format("run.duration_s={}", 0.5 * on.T),
      fmt::format("run.report_interval_s={}", 0.1 * on.T)};
  if (dice.chance(0.5))
    words.push_back(fmt::format("effect.load_spring={{stiffness_Nm_per_rad={},angle_deg=0}}",
                                on.torque() * dice.between(0.1, 2.0)));
  return words;
}

RunSummary run(std::vector<std::string> words, const char* solver, double tolerance) {
  words.push_back(fmt::format("run.relative_tolerance={}", tolerance));
  words.push_back(fmt::format("run.solver={}", solver));
  return run_scenario(load_scenario(shipped("fig08_ramp_07cm_forward.toml"), words, Purpose::run));
}

}  // namespace

TEST_CASE("friction that changes within any share of the speed moves a stop as CVODE finds it") {
  int moving = 0;
  for (std::uint64_t index = 0; index < 120; ++index) {
    Dice dice(26, index);
    const std::vector<std::string> words = swing(dice);
    const double tolerance = dice.decades(1e-12, 1e-8);
    INFO(fmt::format("drive {}, tolerance {}: {}", index, tolerance, fmt::join(words, " ")));
    const RunSummary taylor = run(words, "taylor", tolerance), cvode = run(words, "cvode", 1e-12);
    REQUIRE(taylor.events == cvode.events);
    moving += taylor.total_events() > 4;
    // of a swing of some hundredths of a radian; CVODE's own error is ten times less than the first
    REQUIRE(std::abs(taylor.end.theta_g - cvode.end.theta_g) <= std::max(1e-9, 100.0 * tolerance));
  }
  CHECK(moving > 60);
}

}  // namespace wormdrive::test::scenarios_narrow_friction
