#pragma once
#include <string>
#include <vector>

#include "description/scenario.hpp"

namespace wormdrive {

/// What a scenario is read for: to show a result nothing is judged that the run has been through; statics, checks and
/// diagnoses also take gears that no equation of motion covers, and need no [run].
enum class Purpose { show, look, run };

/// Reads a scenario from TOML text with overrides "table.key=value"; name stands for the text in messages, and the
/// files that it names are looked for beside it. Throws InputFault with every fault at once, one line each with file,
/// line and column.
Scenario parse_scenario(const std::string& text, const std::string& name, const std::vector<std::string>& overrides,
                        Purpose purpose);

}  // namespace wormdrive
