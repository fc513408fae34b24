#pragma once
#include <nlohmann/json.hpp>

namespace wormdrive {

/// The JSON schema of studies.
nlohmann::ordered_json study_schema();

}  // namespace wormdrive
