#pragma once
#include <optional>
#include <string>
#include <vector>

#include "description/scenario.hpp"
#include "near_ties/dice.hpp"

namespace wormdrive::test {

/// A number of a drive, by its key.
struct DrawnNumber {
  std::string key;
  double value;
};

/// A drive as engineers have them: a motor with winding and heat, bristles, a brake, loads that add up, stops, a
/// coupling, a crank, one to six at once, on a time scale of its own.
struct DrawnDrive {
  double period = 0.0;                 ///< of its input [s]; it runs for three of them
  std::vector<std::string> words{};    ///< overrides of a shipped scenario
  std::vector<DrawnNumber> numbers{};  ///< some of them, which move its events
};

DrawnDrive draw_effects(near_ties::Dice& dice);

/// The scenario of a drive and further overrides; throws what loading it throws, as of a drive that would jam.
Scenario scenario_of(const DrawnDrive& drive, const std::vector<std::string>& further);
/// The same, but nothing of a drive that cannot run.
std::optional<Scenario> unless_it_jams(const DrawnDrive& drive, const std::vector<std::string>& further);

}  // namespace wormdrive::test
