#pragma once
#include <string>
#include <string_view>

#include "control/reference.hpp"
#include "description/toml/table_reader.hpp"

namespace wormdrive {

/// Reads [reference] or [[reference]], whose terms add up; CSV files are looked for in `folder`.
Reference read_reference(TableReader& root, const std::string& folder);

/// How a fault ends at a number that is no whole one.
inline constexpr std::string_view must_be_whole = "must be a whole number";
/// Notes that fault.
void require_whole(TableReader& table, const std::string& key, double value);

}  // namespace wormdrive
