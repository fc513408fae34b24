#pragma once
#include <optional>
#include <string_view>

namespace wormdrive {

/// The size in SI of a unit as files state it beside a column: "rad", "N.m", "mrad", "rad*s^-1", "rpm". Nothing if it
/// is no unit of that quantity, which is told by its unit in SI: "s", "rad", "rad/s", "N m", "N", "m", "m/s".
std::optional<double> unit_in_words(std::string_view words, std::string_view si);

}  // namespace wormdrive
