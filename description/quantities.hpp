#pragma once
#include <string>
#include <vector>

#include "description/scenario.hpp"

namespace wormdrive {

/// A number with its name, unit and meaning.
struct Quantity {
  std::string name, unit, meaning;
  double value;
};

/// Every parameter of a scenario that has a value, in the units of its preferred keys.
std::vector<Quantity> parameters(const Scenario& scenario);

/// What follows from the parameters of the mesh and of elastic teeth; nothing without teeth.
std::vector<Quantity> derived(const Scenario& scenario);

/// What follows from elastic teeth, in SI.
struct TeethNumbers {
  double frequency;    ///< at which worm and gear swing against each other while the teeth touch [Hz]
  double contact;      ///< how long an undamped impact lasts [s]
  double gap;          ///< between the flanks along their normal [m]
  double restitution;  ///< of an impact at an approach of 0.1 m/s
};
TeethNumbers teeth_numbers(const Scenario& scenario);

}  // namespace wormdrive
