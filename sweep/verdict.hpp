#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

#include "simulation/solver_cross_check.hpp"

namespace wormdrive {

/// What the referee found of a trial.
struct RefereeVerdict {
  std::uint64_t trial{};
  Disagreement found;      ///< under the recorded torques
  LoopCrossCheck in_loop;  ///< with the trial's own controller, of some of the trials
  bool halted = false;     ///< CVODE could not go on

  /// tolerance: of the gear angle [rad].
  bool agrees(double tolerance) const {
    return !halted && found.angle <= tolerance && (!in_loop.closed || in_loop.closed->angle <= tolerance);
  }
};

/// How many trials a referee looks at, at most, so that all it finds fits into the sweep's file.
inline constexpr std::size_t most_verdicts = 1000;

}  // namespace wormdrive
