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
      now.x = starting_state(drive, {0.1, 1e-3 * sign(motion)}, 0.0);
      const TapeCode* const code = solver.taped().code(now);
      REQUIRE(code != nullptr);
      if (first == nullptr) first = code;
      REQUIRE(*code == *first);
    }
}

}  // namespace

TEST_CASE("tapes: the operations are the same in both directions and on both flanks, whatever effects are on") {
  int with_states = 0;
  for (std::uint64_t index = 0; index < 200; ++index) {
    Dice dice(24, index);
    const RandomLoop loop = draw_loop(dice);
    std::vector<std::string> words = nominal_words(dice, loop);
    const bool states = dice.chance(0.5);
    for (const std::string& word : states ? effects_with_states(dice, loop) : additions(dice, loop, 3))
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

}  // namespace wormdrive::test::scenarios_taped_modes
