#pragma once
#include <string>
#include <vector>

#include "scenarios/scenario.hpp"

namespace wormdrive {

/// What follows from elastic teeth, in the units in which it is read.
struct TeethNumbers {
  double frequency;    ///< at which worm and gear swing against each other while the teeth touch [Hz]
  double contact;      ///< how long an undamped impact lasts [s]
  double gap;          ///< between the flanks along their normal [m]
  double restitution;  ///< of an impact at an approach of 0.1 m/s
};
TeethNumbers teeth_numbers(const Scenario& scenario);

/// "elastic, 1e+06 N/m, contact frequency 1.3 kHz, ...": what stands for the rigid drive.
std::string describe_teeth(const Scenario& scenario);

}  // namespace wormdrive
