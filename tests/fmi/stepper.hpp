#pragma once
#include <cmath>

#include "fmi/importer.hpp"

namespace wormdrive::test {

/// What an importer sees at a communication point.
struct Point {
  double t, angle, speed;
  int events;
  double latest;
};

/// One instance that goes from step to step [FMI 2.0.4, section 4.2.4].
class Stepper {
 public:
  Stepper(const Fmu& fmu, double end, double start = 0.0) : model(fmu, "", fmi2CoSimulation), t(start) {
    model.call<decltype(fmi2SetupExperiment)>("fmi2SetupExperiment", 0, 0.0, start, 1, end);
    model.call<decltype(fmi2EnterInitializationMode)>("fmi2EnterInitializationMode");
    model.call<decltype(fmi2ExitInitializationMode)>("fmi2ExitInitializationMode");
  }
  Point step(double h) {
    model.call<decltype(fmi2DoStep)>("fmi2DoStep", t, h, fmi2Boolean{1});
    t += h;
    return {t, model.real("gear_angle"), model.real("gear_speed"), model.integer("event_count"),
            model.real("event_time")};
  }
  Point last(double end, double h) {
    Point at{};
    for (long k = std::lround((end - t) / h); k > 0; --k) at = step(h);
    return at;
  }

  Instance model;
  double t;
};

}  // namespace wormdrive::test
