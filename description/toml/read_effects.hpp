#pragma once
#include "description/toml/parse_scenario.hpp"
#include "description/toml/table_reader.hpp"

namespace wormdrive {

/// Reads [effect.ID] tables into a scenario whose mesh is known, and refuses what bounds alone cannot.
void read_effects(TableReader& root, Scenario& scenario, Purpose purpose);

}  // namespace wormdrive
