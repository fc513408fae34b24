#pragma once
#include <string>
#include <vector>

#include "scenarios/scenario.hpp"

namespace wormdrive {

/// What a scenario is read for: to show a result nothing is judged that the run has been through; statics, checks and
/// diagnoses also take gears that no equation of motion covers, and need no [run].
enum class Purpose { show, look, run };

/// Reads a scenario from a TOML file, or from a result file that carries one, with overrides "table.key=value".
/// Throws InputFault with every fault at once, one line each with file, line and column.
Scenario load_scenario(const std::string& path, const std::vector<std::string>& overrides, Purpose purpose);

/// The same from TOML text; name stands for it in messages, and files are looked for beside it.
Scenario parse_scenario(const std::string& text, const std::string& name, const std::vector<std::string>& overrides,
                        Purpose purpose);

}  // namespace wormdrive
