#pragma once
#include <stdexcept>
#include <string>

#include "core/mode.hpp"

namespace wormdrive {

/// A simulation that cannot go on; what() says at which time, in which mode, after which events and why.
struct SimulationFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// "forward, left flank"
std::string describe(Mode mode);

/// A fault of a solver, without the circumstances, which the loop adds.
struct SolverFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace wormdrive
