#pragma once
#include "control/anti_windup.hpp"
#include "control/closed_loop.hpp"
#include "control/controller.hpp"
#include "control/metrics.hpp"

namespace wormdrive {

/// What a controlled run has beside the drive, as it is stated.
struct ControlScenario {
  ControllerParameters law;
  SamplingSettings sampling;
  AntiWindupSettings anti_windup;
  NominalSettings nominal;
  Variations variations;
  Reference reference;
  SensorSettings sensor;
  DisturbanceSettings disturbance;
  MetricsWindow window;
};

}  // namespace wormdrive
