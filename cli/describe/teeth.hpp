#pragma once
#include <string>
#include <vector>

#include "description/scenario.hpp"

namespace wormdrive {

/// "elastic, 1e+06 N/m, contact frequency 1.3 kHz, ...": what stands for the rigid drive.
std::string describe_teeth(const Scenario& scenario);

}  // namespace wormdrive
