#pragma once
#include <string>

#include "control/reference.hpp"
#include "description/toml/table_reader.hpp"

namespace wormdrive {

/// Reads [reference] or [[reference]], whose terms add up; CSV files are looked for in `folder`.
Reference read_reference(TableReader& root, const std::string& folder);

}  // namespace wormdrive
