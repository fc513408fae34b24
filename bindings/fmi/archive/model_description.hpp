#pragma once
#include <string>

#include "bindings/fmi/fmu_model.hpp"

namespace wormdrive {

/// The name by which the files of every FMU of this program call its library.
inline constexpr std::string_view model_identifier = "wormdrive_fmu";

/// modelDescription.xml of FMI 2.0 for a model with its token.
std::string fmi2_description(const FmuModel& model);

/// modelDescription.xml of FMI 3.0, and its terminals: the shafts on which the drive is connected.
std::string fmi3_description(const FmuModel& model);
std::string fmi3_terminals(const FmuModel& model);

}  // namespace wormdrive
