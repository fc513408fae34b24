#pragma once
#include <string>
#include <string_view>

#include "control/reference.hpp"
#include "description/toml/table_reader.hpp"

namespace wormdrive {

/// Reads [reference] or [[reference]], whose terms add up; CSV files are looked for in `folder`.
Reference read_reference(TableReader& root, const std::string& folder);

/// Notes a fault at a number that is no whole one; it ends with these words.
inline constexpr std::string_view must_be_whole = "must be a whole number";
void require_whole(TableReader& table, const std::string& key, double value);

}  // namespace wormdrive
