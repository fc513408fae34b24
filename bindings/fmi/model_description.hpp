#pragma once
#include <string>

#include "description/scenario.hpp"

namespace wormdrive {

/// The name by which the files of every FMU of this program call its library.
inline constexpr std::string_view model_identifier = "wormdrive_fmu";

/// modelDescription.xml of FMI 2.0 for the plant of a scenario; guid as in plant_json.hpp.
std::string model_description(const Scenario& scenario, const std::string& guid);

}  // namespace wormdrive
