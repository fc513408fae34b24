#pragma once
#include <optional>
#include <string>

#include "description/scenario.hpp"
#include "output/replacing.hpp"

namespace wormdrive {

/// What keeps the plant of a scenario from being an FMU, or nothing: a delay and a lag need a memory of the input.
std::optional<std::string> not_exportable(const Scenario& scenario);

/// Writes the plant of a scenario as an FMU of FMI 2.0 for model exchange; as NAME.part until it is complete.
/// Throws OutputFault, also if what is there may not be replaced.
void export_fmu(const Scenario& scenario, const std::string& path, Replace replace = Replace::same_kind);

}  // namespace wormdrive
