#pragma once
#include <limits>

#include "control/reference_point.hpp"

namespace wormdrive {

/// What a controller is told at a sample, of one trial or of several at once.
template <class V>
struct MeasurementOf {
  double t;       ///< [s]
  V angle;        ///< measured gear angle [rad]
  V speed;        ///< estimated gear speed [rad/s]
  double period;  ///< time since the previous sample [s]
  ReferencePoint desired;
  V applied = 0.0;  ///< what the actuator's limit left of the torque decided at the sample before [N m]
  V limit = std::numeric_limits<double>::infinity();  ///< largest magnitude that it leaves [N m]
};
using Measurement = MeasurementOf<double>;

/// What a controller decides, and what it lets others see.
template <class V>
struct ControlSignalsOf {
  V torque = 0.0;        ///< motor torque to hold [N m]
  V s = 0.0;             ///< sliding variable [rad/s]; 0 for other controllers
  V u = 0.0;             ///< its input tau_m - (Jw i/Jg) tau_l_hat [N m]; 0 for other controllers
  V compensation = 0.0;  ///< part of the torque that is break-in compensation [N m]
};
using ControlSignals = ControlSignalsOf<double>;

}  // namespace wormdrive
