#pragma once
#include "control/controller_signals.hpp"

namespace wormdrive {

/// What happened at one sample, of one trial or of several at once.
template <class V>
struct ControlRecordOf {
  V gear_angle;  ///< the true one [rad]
  MeasurementOf<V> measured;
  ControlSignalsOf<V> decided;
  V applied;      ///< command that the motor has from this sample on: delayed, limited [N m]
  V disturbance;  ///< random torque on the worm's shaft, likewise [N m]
};
using ControlRecord = ControlRecordOf<double>;

}  // namespace wormdrive
