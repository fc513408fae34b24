#pragma once
#include <string>
#include <vector>

#include "description/scenario.hpp"

namespace wormdrive {

/// What a user should know about his scenario before he trusts it, one sentence each.
std::vector<std::string> warnings(const Scenario& scenario);

}  // namespace wormdrive
