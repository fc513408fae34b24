#pragma once
#include <optional>

#include "scenarios/scenario.hpp"

namespace wormdrive {

/// How far CVODE is from the solver that made a run.
struct Disagreement {
  double angle = 0.0;  ///< largest difference of the gear angle [rad]
  double speed = 0.0;  ///< of the gear speed [rad/s]
  double t = 0.0;      ///< when the angles differ most [s]
};

/// What CVODE says of a run.
struct SecondOpinion {
  Disagreement replayed;  ///< under the very torques that the run's controller gave; of an open loop: as it is
  std::optional<Disagreement> closed;  ///< with its own controller, where no sensor rounds to counts
  std::optional<double> parted;        ///< where one does: when the two first read another count [s], if ever
};

/// Runs a scenario as it is stated, then with CVODE, and compares the states at all samples and reports: first under the
/// torques that the controller gave, then with the controller in the loop, which amplifies what the solvers differ by. A
/// sensor's count flips for the last digit, so that behind the first one nothing can be compared any more. The teeth
/// must be rigid. Throws Halt if one of the runs cannot go on.
SecondOpinion second_opinion(const Scenario& scenario);

}  // namespace wormdrive
