#include <cmath>
#include <variant>

#include "core/elastic/elastic_teeth.hpp"
#include "simulation/lanes/lane_run.hpp"

namespace wormdrive {
namespace {

/// Whether lanes may know the drive, whatever loads it and limits its torque.
bool has_held_torque(const Scenario& scenario) {
  const Effects<double>& on = scenario.effects;
  return scenario.run.solver == SolverKind::taylor && std::holds_alternative<MeshParameters<double>>(scenario.mesh) &&
         scenario.motor.terms.empty() && !has_elastic_teeth(on);
}

/// How far apart two times of a run have to be, so that rounding does not make them one [s].
double rounding_of_times(const Scenario& scenario) { return 4.0 * time_resolution(scenario.run.duration); }

/// Whether a command reaches the motor before the next one is given, and the motor does not lag as well.
bool arrives_within_sample(const Scenario& scenario) {
  const double delay = scenario.effects.delay();
  return delay <= 0.0 ||
         (scenario.effects.lag() <= 0.0 && delay + rounding_of_times(scenario) < scenario.control->sampling.period);
}

/// Whether a sample sees the angle as it is, or one that is younger than the sample before, of a motion in one step.
bool sees_within_sample(const Scenario& scenario) {
  const double age = scenario.effects.measuring_delay(), rounding = rounding_of_times(scenario);
  return age <= 0.0 || (age > rounding && age + rounding < scenario.control->sampling.period &&
                        scenario.effects.delay() <= 0.0 && scenario.effects.lag() <= 0.0);
}

/// Whether lanes know what a controller is told and how it decides.
bool has_lane_controller(const ControlScenario& control) {
  const SensorSettings& sensor = control.sensor;
  return (std::holds_alternative<SlidingParameters>(control.law) ||
          std::holds_alternative<PidParameters>(control.law)) &&
         control.anti_windup.method == AntiWindup::none && (sensor.zero_error == 0.0 || !sensor.index_mark) &&
         !sensor.exact_speed && !sensor.on_worm;
}

}  // namespace

bool has_lane_plant(const Scenario& scenario) {
  return has_held_torque(scenario) && !scenario.effects.have_states() &&
         std::holds_alternative<GravityArm>(scenario.load) && std::isinf(scenario.effects.torque_limit()) &&
         scenario.effects.lag() <= 0.0 && scenario.effects.delay() <= 0.0;
}

bool fits_lane(const Scenario& scenario) {
  return scenario.control && has_lane_controller(*scenario.control) && has_held_torque(scenario) &&
         arrives_within_sample(scenario) && sees_within_sample(scenario);
}

bool share_samples(const Scenario& a, const Scenario& b) {
  if (!a.control || !b.control) return false;
  const SolverSettings x = a.run.solver_settings(), y = b.run.solver_settings();
  return a.control->reference == b.control->reference && a.control->sampling == b.control->sampling &&
         a.control->window == b.control->window && a.run.duration == b.run.duration &&
         x.relative_tolerance == y.relative_tolerance && x.absolute_tolerance == y.absolute_tolerance &&
         x.max_step == y.max_step;
}

}  // namespace wormdrive
