#pragma once
// What programs share that step gears and count what their whole process allocates.
#include <cstddef>
#include <string>
#include <vector>

#include "description/scenario.hpp"

namespace wormdrive::test {

extern long allocations;  ///< since the process began

/// Gears of the paper with an arm, each with more friction than the one before.
std::vector<Scenario> gears(std::size_t count, const std::vector<std::string>& overrides);

}  // namespace wormdrive::test
