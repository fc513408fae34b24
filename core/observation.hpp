#pragma once
#include "core/mode.hpp"

namespace wormdrive {

/// What a drive shows at one instant, in SI.
struct Observation {
  double theta_g;       ///< gear angle [rad]
  double omega_g;       ///< gear speed [rad/s]
  double alpha_g;       ///< gear acceleration [rad/s^2]
  double tau_m;         ///< motor torque [N m]
  double tau_l;         ///< load torque on the gear [N m]
  double normal_force;  ///< Wn [N]
  Mode mode;
};

}  // namespace wormdrive
