#pragma once
#include <optional>
#include <string>

#include "bindings/fmi/fmu_model.hpp"
#include "output/replacing.hpp"

namespace wormdrive {

/// What keeps a model from being an FMU, or nothing.
std::optional<std::string> not_exportable(const FmuModel& model);

/// Writes a model as an FMU of a version of the standard, 2 or 3; as NAME.part until it is complete. Throws
/// OutputFault, also if what is there may not be replaced.
void export_fmu(const FmuModel& model, int version, const std::string& path, Replace replace = Replace::same_kind);

}  // namespace wormdrive
