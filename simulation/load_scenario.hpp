#pragma once
#include <string>
#include <vector>

#include "description/toml/parse_scenario.hpp"

namespace wormdrive {

/// Reads a scenario from a TOML file, or from a result file that carries one, with overrides "table.key=value". Throws
/// InputFault as parse_scenario() does.
Scenario load_scenario(const std::string& path, const std::vector<std::string>& overrides, Purpose purpose);

}  // namespace wormdrive
