#pragma once
// Recordings for the tests of the diagnosis' parts: the program's own closed loop, disturbed and measured.
#include <cmath>
#include <cstdint>
#include <vector>

#include "diagnosis/experiment/experiment.hpp"
#include "statistics/random.hpp"

namespace wormdrive::test {

/// Slow sweeps, several sines and random steps over an angle on which the load changes its sign.
inline std::vector<ReferenceTerm> rich_motion() {
  return {SinusoidReference{.amplitude = 2.0, .frequency = 0.045},
          MultisineReference{.amplitude = 0.03, .lowest_frequency = 0.7, .highest_frequency = 9.0, .count = 7},
          RandomStepsReference{.amplitude = 0.25, .interval = 1.7, .seed = 5},
          SinusoidReference{.amplitude = 0.12, .frequency = 1.5}};
}

struct RecordingConditions {
  double duration = 16.0;        ///< [s]
  double period = 2e-3;          ///< [s]
  double white_torque = 5e-4;    ///< [N m]
  double counts = 65536;         ///< of the gear's encoder per turn
  double angle_noise = 3e-5;     ///< [rad]
  double coloured_torque = 0.0;  ///< [N m]
  std::uint64_t seed = 1;
  std::vector<ReferenceTerm> motion = rich_motion();
};

/// The paper's drive with 1 kg on 7 cm: what the diagnosis is told.
inline Scenario nominal_arm() {
  Scenario s;
  s.title = "arm";
  s.mesh = MeshParameters<double>{.i = 60,
                                  .lambda = 4 * unit::degree,
                                  .phi_n = 20 * unit::degree,
                                  .lw = 0.011,
                                  .lg = 0.045,
                                  .mu = 0.25,
                                  .Jw = 2.53e-5,
                                  .Jg = 7.39e-4};
  GravityArm arm;
  arm.mass = 1.0;
  arm.arm = 0.07;
  s.load = arm;
  s.run.duration = 16.0;
  return s;
}

/// Records a drive that follows a motion.
inline Recording record(Scenario drive, const RecordingConditions& conditions = {}) {
  ControlScenario control;
  PidParameters pid;
  pid.integral_weight = 4.0;
  pid.angle_weight = 1.0;
  pid.speed_weight = 1e-3;
  pid.feedforward = 1.0;
  control.law = pid;
  control.sampling.period = conditions.period;
  control.reference.terms = conditions.motion;
  control.sensor.counts = conditions.counts;
  control.sensor.noise = conditions.angle_noise;
  control.sensor.seed = static_cast<double>(conditions.seed);
  control.sensor.filter_cutoff = 100.0;
  control.disturbance.deviation = std::hypot(conditions.white_torque, conditions.coloured_torque);
  control.disturbance.time_constant = conditions.coloured_torque > 0.0 ? 0.05 : 0.0;
  control.disturbance.seed = static_cast<double>(conditions.seed);
  drive.control = control;
  drive.run.duration = conditions.duration;
  drive.run.solver = SolverKind::taylor;
  drive.run.relative_tolerance = 1e-9;
  return simulated(drive);
}

}  // namespace wormdrive::test
