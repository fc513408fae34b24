#pragma once
#include "control/reference_point.hpp"

namespace wormdrive {

/// What a controller is told at a sample.
struct Measurement {
  double t;       ///< [s]
  double angle;   ///< measured gear angle [rad]
  double speed;   ///< estimated gear speed [rad/s]
  double period;  ///< time since the previous sample [s]
  ReferencePoint desired;
};

/// What a controller decides, and what it lets others see.
struct ControlSignals {
  double torque = 0.0;        ///< motor torque to hold [N m]
  double s = 0.0;             ///< sliding variable [rad/s]; 0 for other controllers
  double u = 0.0;             ///< its input tau_m - (Jw i/Jg) tau_l_hat [N m]; 0 for other controllers
  double compensation = 0.0;  ///< part of the torque that is break-in compensation [N m]
};

}  // namespace wormdrive
