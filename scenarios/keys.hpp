#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/unit.hpp"
#include "output/run_file.hpp"

namespace wormdrive {

/// How a field is written in a file: its key, and the unit in which its number stands.
struct Spelling {
  std::string key;
  Unit unit;
};

/// The spellings under which a field may be written, the preferred one first: angles in deg or rad; for a linear axis
/// torque becomes force, angle position, inertia mass.
std::vector<Spelling> spellings(std::string_view name, const Unit& unit, Axis axis);

/// "did you mean 'x'?" for the most similar of the valid keys, or the list of them if none is similar.
std::string suggestion(std::string_view unknown, const std::vector<std::string>& valid);

}  // namespace wormdrive
