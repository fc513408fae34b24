#pragma once
#include <string>

#include "description/toml/parse_scenario.hpp"
#include "description/toml/table_reader.hpp"

namespace wormdrive {

/// Reads [effect.ID] tables into a scenario whose mesh is known, and refuses what bounds alone cannot; folder: of the
/// CSV files.
void read_effects(TableReader& root, Scenario& scenario, const std::string& folder, Purpose purpose);

}  // namespace wormdrive
