#pragma once
#include <string>

#include "description/scenario.hpp"

namespace wormdrive {

/// The plant of a scenario (mesh, load, effects, initial state) as JSON in SI: what an FMU carries with it.
std::string plant_to_json(const Scenario& scenario);

/// The plant again, bit for bit. Throws std::exception where the text is none.
Scenario plant_from_json(const std::string& text);

/// What tells one plant from another, as a UUID in braces.
std::string guid_of(const std::string& plant);

}  // namespace wormdrive
