#pragma once
#include "description/scenario.hpp"

namespace wormdrive {

/// Over which speeds and loads a drive is shown, where nobody states it.
struct OperatingRange {
  double worm_speed;   ///< [rad/s]; of one mass alone its own
  double load_torque;  ///< [N m]
};

/// What the scenario's own run reaches, with half as much room again for the load, which a gravity arm counts by its
/// amplitude. A drive that does not move shows a turn of its gear within a second; one without a load, as much as its
/// motor would hold without losses; one without either, 1 N m.
OperatingRange operating_range(const Scenario& scenario);

}  // namespace wormdrive
