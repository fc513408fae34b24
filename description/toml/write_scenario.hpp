#pragma once
#include <string>

#include "description/scenario.hpp"

namespace wormdrive {

/// The resolved scenario as TOML: every parameter stated, files inlined; reading it gives the same bits.
std::string to_toml(const Scenario& scenario);

}  // namespace wormdrive
