#pragma once
#include <functional>
#include <string>
#include <vector>

#include "description/quantities.hpp"

namespace wormdrive {

/// A number of a scenario that whoever views it may change, and how far its slider goes.
struct Slider {
  Quantity quantity;  ///< named by its key
  double low, high;
};

/// Tries a scenario with one override; true if it can be run.
using Admits = std::function<bool(const std::string& key, double value)>;

/// The sliders that are asked for, "table.key" or "table.key=low..high"; all that can be had where none is. A slider
/// without a range goes from half the value to twice, as far as the scenario admits it. Throws InputFault for a key
/// that the scenario does not have, for a range that is none, and for a value of zero without a range.
std::vector<Slider> sliders(const Scenario& scenario, const std::vector<std::string>& wanted, const Admits& admits);

}  // namespace wormdrive
