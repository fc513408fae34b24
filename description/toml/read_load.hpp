#pragma once
#include <string>

#include "core/load.hpp"
#include "description/toml/table_reader.hpp"

namespace wormdrive {

/// Reads [load] or [[load]] of a scenario; CSV files are looked for in `folder`.
LoadParameters read_load(TableReader& root, const std::string& folder);

}  // namespace wormdrive
