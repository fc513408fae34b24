#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/axis.hpp"
#include "core/unit.hpp"

namespace wormdrive {

/// How a field is written in a file: its key, and the unit in which its number stands.
struct Spelling {
  std::string key;
  Unit unit;
  std::string stem{};  ///< the key without its unit
};

/// The spellings under which a field may be written, the preferred one first: angles in deg or rad,
/// shares in percent or as they are; for a linear axis
/// torque becomes force, angle position, inertia mass.
std::vector<Spelling> spellings(std::string_view name, const Unit& unit, Axis axis);

/// That in which a number in SI is written.
Spelling si_spelling(std::string_view name, const Unit& unit, Axis axis);

/// The meaning of a field in the words of an axis: "torque" becomes "force".
std::string in_words_of(Axis axis, std::string_view meaning);

/// The valid key that is so similar to an unknown one that it was probably meant.
std::optional<std::string> probably_meant(std::string_view unknown, const std::vector<std::string>& valid);

/// "did you mean 'x'?" for the key that was probably meant, or the list of the valid keys.
std::string suggestion(std::string_view unknown, const std::vector<std::string>& valid);

}  // namespace wormdrive
