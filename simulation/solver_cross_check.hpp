#pragma once
#include <optional>

#include "description/scenario.hpp"

namespace wormdrive {

/// How far CVODE is from the solver that made a run.
struct Disagreement {
  double angle = 0.0;  ///< largest difference of the gear angle [rad]
  double speed = 0.0;  ///< of the gear speed [rad/s]
  double t = 0.0;      ///< when the angles differ most [s]
};

/// Runs a scenario as it is stated, then with CVODE under the very torques that its controller gave, and compares the
/// states at all samples and reports: a closed loop would amplify the last digit of either. The teeth must be rigid.
/// Throws SimulationFailure if one of the runs cannot go on.
Disagreement cross_check(const Scenario& scenario);

/// What CVODE says of a closed loop.
struct LoopCrossCheck {
  std::optional<Disagreement> closed;  ///< where no sensor rounds to counts
  std::optional<double> parted;        ///< where one does: when the two first read another count [s], if ever
};

/// The same with the controller acting on what CVODE finds. A sensor's count flips for the last digit, so that behind
/// the first one nothing can be compared any more.
LoopCrossCheck cross_check_in_the_loop(const Scenario& scenario);

}  // namespace wormdrive
