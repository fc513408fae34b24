#pragma once
#include <string>

#include "bindings/fmi/fmu_model.hpp"

namespace wormdrive {

/// The model of an FMU (mesh, load, effects, initial state; of a loop motor torque and controller, too) as JSON in SI:
/// what the FMU carries with it.
std::string plant_to_json(const FmuModel& model);

/// The model again, bit for bit, without its token. Throws std::exception where the text is none.
FmuModel plant_from_json(const std::string& text);

/// What tells one plant from another, as a UUID in braces.
std::string guid_of(const std::string& plant);

}  // namespace wormdrive
