#pragma once
#include <string>
#include <vector>

#include "near_ties/dice.hpp"

namespace wormdrive::test {

/// The closed loop of fig. 10 on a scale of its own: times over four decades, inertias over six.
struct RandomLoop {
  double T, J;  ///< multiples of the paper's times and inertias
  bool pid;
  double torque() const { return J / (T * T); }
  double drag() const { return J / T; }
};

RandomLoop draw_loop(near_ties::Dice& dice);
/// Overrides of a shipped scenario, see law_of(), that make it such a loop.
std::vector<std::string> nominal_words(near_ties::Dice& dice, const RandomLoop& on);
const char* law_of(const RandomLoop& on);
/// Up to so many effects, loads, sensors and motors without states; an asymmetry comes with the friction that it
/// belongs to.
std::vector<std::string> additions(near_ties::Dice& dice, const RandomLoop& on, int most);
/// One or two that compare, or are others from a time on: friction under load, a brake, stops, a fan.
std::vector<std::string> what_compares(near_ties::Dice& dice, const RandomLoop& on);
/// One or two effects with states.
std::vector<std::string> effects_with_states(near_ties::Dice& dice, const RandomLoop& on);

}  // namespace wormdrive::test
