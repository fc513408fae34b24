#pragma once
#include <variant>

#include "control/open_loop.hpp"
#include "control/pid.hpp"
#include "control/sliding.hpp"

namespace wormdrive {

/// Every kind of controller as it is stated; a new one is a new file and one entry here. It names itself by `kind` and
/// `meaning`, lists its `fields()`, and its `make_controller` leads to a callable Measurement -> ControlSignals.
using ControllerParameters = std::variant<SlidingParameters, PidParameters, OpenLoopParameters>;

}  // namespace wormdrive
