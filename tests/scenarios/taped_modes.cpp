#include <fmt/format.h>
#include <fmt/ranges.h>

#include "catch.hpp"
#include "cli/program.hpp"
#include "core/states/starting_state.hpp"
#include "description/build.hpp"
#include "events/taylor/solver.hpp"
#include "scenarios/random_loops.hpp"
#include "simulation/load_scenario.hpp"

// Trials in different modes share a register only where their equations are the same operations.

namespace wormdrive::test::scenarios_taped_modes {

namespace {

using near_ties::Dice;

/// Requires that a drive's operations are the same in both directions and on both flanks.
template <class Drive>
void require_the_same(Drive drive, const Scenario& scenario) {
  drive.enter(0.0);
  TaylorSolver<Drive> solver(drive, scenario.run.solver_settings());
  const TapeCode* first = nullptr;
  for (const Motion motion : {Motion::forward, Motion::backward})
    for (const Flank flank : {Flank::left, Flank::right}) {
      typename Drive::Instant now;
      now.mode = {motion, flank};
      for (const double theta_g : {-1.5, -0.1, 0.1, 1.5}) {  // also where stops push
        now.x = starting_state(drive, {theta_g, 1e-3 * sign(motion)}, 0.0);
        const TapeCode* const code = solver.taped().code(now);
        REQUIRE(code != nullptr);
        if (first == nullptr) first = code;
        REQUIRE(*code == *first);
      }
    }
}

}  // namespace

TEST_CASE("tapes: the operations are the same in both directions and on both flanks, whatever effects are on") {
  int with_states = 0;
  for (std::uint64_t index = 0; index < 200; ++index) {
    Dice dice(24, index);
    const RandomLoop loop = draw_loop(dice);
    std::vector<std::string> words = nominal_words(dice, loop);
    const double kind = dice.between(0.0, 1.0);
    for (const std::string& word : kind < 0.5    ? effects_with_states(dice, loop)
                                   : kind < 0.75 ? what_compares(dice, loop)
                                                 : additions(dice, loop, 3))
      words.push_back(word);
    INFO(fmt::format("drive {}: {}", index, fmt::join(words, " ")));
    const Scenario scenario = load_scenario(shipped(law_of(loop)), words, Purpose::run);
    if (scenario.effects.have_states())
      require_the_same(make_drive<true>(scenario), scenario);
    else
      require_the_same(make_drive(scenario), scenario);
    with_states += scenario.effects.have_states();
  }
  CHECK(with_states > 80);
}

TEST_CASE("tapes: a drive with states that is far from all events leaps, by few terms or many") {
  for (const char* const effect :
       {"effect.hard_stops={angle_low_deg=-6,angle_high_deg=6}",
        "effect.worm_lugre={coulomb_torque_Nm=2e-3,stiffness_Nm_per_rad=0.05}",
        "effect.gearbox_heat={friction_decay_per_K=5e-3,heat_capacity_J_per_K=100,thermal_resistance_K_per_W=1}",
        "effect.dc_motor={resistance_ohm=0.8,torque_constant_Nm_per_A=0.04,inductance_H=6e-4,supply_voltage_V=24,"
        "current_bandwidth_Hz=50,current_limit_A=8}"})
    for (const char* const tolerance : {"1e-6", "1e-10", "1e-13"}) {
      CAPTURE(effect, tolerance);
      const Scenario scenario = load_scenario(
          shipped("fig10_sliding_014rad_bare.toml"),
          {"run.solver=taylor", fmt::format("run.relative_tolerance={}", tolerance), effect}, Purpose::run);
      auto drive = make_drive<true>(scenario);
      using Drive = decltype(drive);
      drive.enter(0.0);
      drive.command(0.0, 0.02);
      TaylorSolver<Drive> solver(drive, scenario.run.solver_settings());
      typename Drive::Instant now;
      now.x = starting_state(drive, {0.01, 1.0}, 0.0);
      now.mode = drive.settle(now);
      REQUIRE(solver.taped().covers(now));
      CHECK(solver.taped().leap(now, 1e-3, TaylorAccuracy(scenario.run.solver_settings())));
      CHECK(now.t >= 0.25e-3);  // all of it, or as far as the longest series get
    }
}

}  // namespace wormdrive::test::scenarios_taped_modes
