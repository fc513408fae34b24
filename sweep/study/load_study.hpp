#pragma once
#include <optional>
#include <string>

#include "sweep/study/study.hpp"

namespace wormdrive {

/// Reads a study from a TOML file and the scenario that it names, which is looked for beside it.
/// Throws InputFault with every fault at once, one line each with file, line and column.
Study load_study(const std::string& path);

/// The same from a text; path stands for the file: in messages, and for the folder of the scenario.
Study read_study(const std::string& text, const std::string& path);

/// The same from the texts that a sweep file carries: the study, and its scenario with every parameter at its median.
/// name stands for the file in messages.
Study parse_study(const std::string& text, const std::string& scenario, const std::string& name);

/// The first thing in which two TOML texts differ, "sweep.trials: 100, then 200"; comments and order do not count.
std::optional<std::string> difference(const std::string& before, const std::string& after);

}  // namespace wormdrive
