#include "simulation/lane_run.hpp"

#include <cmath>

#include "core/elastic/elastic_teeth.hpp"

namespace wormdrive {
namespace {

const SlidingParameters& sliding(const Scenario& scenario) {
  return std::get<SlidingParameters>(scenario.control->law);
}

bool has_sensor(const Effects<double>& effects) {
  bool sensor = false;
  effects.for_each([&]<class E>(const std::optional<E>& effect) {
    if (effect && E::place == Place::sensor) sensor = true;
  });
  return sensor;
}

/// Whether lanes know the drive, whose torques may be cut at a limit.
bool has_limited_lane_plant(const Scenario& scenario) {
  const Effects<double>& on = scenario.effects;
  return scenario.run.solver == SolverKind::taylor && std::holds_alternative<MeshParameters<double>>(scenario.mesh) &&
         std::holds_alternative<GravityArm>(scenario.load) && scenario.motor.terms.empty() && !has_elastic_teeth(on) &&
         !on.have_states() && on.delay() <= 0.0 && on.lag() <= 0.0;
}

}  // namespace

bool has_lane_plant(const Scenario& scenario) {
  return has_limited_lane_plant(scenario) && std::isinf(scenario.effects.torque_limit());
}

bool fits_lane(const Scenario& scenario) {
  const auto& control = scenario.control;
  return control && std::holds_alternative<SlidingParameters>(control->law) && has_limited_lane_plant(scenario) &&
         control->sampling.delay <= 0.5 && control->sensor.counts <= 0.0 && control->sensor.noise <= 0.0 &&
         !control->sensor.exact_speed && !control->sensor.on_worm && control->disturbance.deviation <= 0.0 &&
         !has_sensor(scenario.effects);
}

bool share_samples(const Scenario& a, const Scenario& b) {
  if (!a.control || !b.control) return false;
  const SolverSettings x = a.run.solver_settings(), y = b.run.solver_settings();
  return a.control->reference == b.control->reference && a.control->sampling == b.control->sampling &&
         a.control->window == b.control->window && a.run.duration == b.run.duration &&
         x.relative_tolerance == y.relative_tolerance && x.absolute_tolerance == y.absolute_tolerance &&
         x.max_step == y.max_step;
}

struct LaneRun::Torque {
  double torque = 0.0;
  bool held = false;

  bool pause() const { return held; }
  double sample(const Drive&, const Drive::Instant&) {
    held = true;
    return torque;
  }
};

LaneRun::LaneRun(const Scenario& scenario)
    : scenario_(scenario),
      drive_(make_drive(scenario, std::get<GravityArm>(scenario.load), scenario.effects, scenario.motor)),
      solver_(drive_, scenario.run.solver_settings()),
      run_(drive_, solver_, scenario, nobody_),
      controller_(make_controller(sliding(scenario), make_nominal(scenario), make_variations(scenario))),
      watch_(scenario.control->window, scenario.control->law, make_lemma1(scenario)),
      progress_{run_.timetable(*scenario.control), run_.start(), EventLog()} {}

bool LaneRun::has_closed_form() const {
  for (const Motion motion : {Motion::forward, Motion::backward})
    for (const Flank flank : {Flank::left, Flank::right})
      if (!solver_.nominal().driven({motion, flank})) return false;
  return true;
}

void LaneRun::start(const Lane& lane) {
  advance({.held = true});
  const NominalModel& nominal = controller_.nominal();
  const ControlScenario& control = *scenario_.control;
  LaneTrial<double> trial{.law = controller_.law(),
                          .load_torque = nominal.load_torque,
                          .load_angle_offset = nominal.load_angle_offset,
                          .load_constant = nominal.load_constant,
                          .speed = {control.sensor.filter_cutoff, control.sampling.period},
                          .sums = watch_.meter.sums(),
                          .quiet = watch_.lemma->quiet(),
                          .limit = drive_.torque_limit(),
                          .drive = {},
                          .arm_offset = solver_.nominal().arm_offset(),
                          .theta = 0.0,
                          .omega = 0.0};
  leave(trial);
  trial.speed.start(trial.theta);
  lane.write(trial);
}

void LaneRun::go_on(const Lane& lane, long sample, double t, double torque) {
  LaneTrial<double> trial = lane.read();
  if (sample != next_) {
    solver_.count_leaps(sample - next_);
    progress_.timetable.skip_to_sample(sample);
    progress_.now.t = t;
    progress_.now.x = {trial.theta, trial.omega};
    progress_.cause = {Reason::sample};
    watch_.meter.instant(t, progress_.now.mode);
    run_.record(drive_, progress_.now);
  }
  advance({.torque = torque});
  next_ = sample + 1;
  leave(trial);
  lane.write(trial);
}

void LaneRun::note(const Lane& lane, const ControlRecord& record) {
  const bool was_reached = !std::isnan(watch_.lemma->reached());
  watch_.lemma->sample(record);
  if (was_reached || std::isnan(watch_.lemma->reached())) return;
  LaneTrial<double> trial = lane.read();
  trial.quiet = watch_.lemma->quiet();
  lane.write(trial);
}

RunSummary LaneRun::finish(const Lane& lane, long samples) {
  watch_.meter.sampled(lane.read().sums, samples);
  RunSummary summary = run_.finish();
  summary.control = watch_.summary();
  return summary;
}

void LaneRun::advance(Torque torque) {
  wormdrive::go_on(drive_, solver_, torque, progress_, [this](const Drive& drive, const Drive::Instant& now) {
    watch_.meter.instant(now.t, now.mode);
    run_.record(drive, now);
  });
}

/// Leaves state and mode to the lane; at rest, with motion 0, no step is known beforehand.
void LaneRun::leave(LaneTrial<double>& trial) const {
  const Drive::Instant& now = progress_.now;
  trial.theta = now.x[0];
  trial.omega = now.x[1];
  trial.drive = Drive::at_rest(now.mode) ? DrivenMotion{} : *solver_.nominal().driven(now.mode);
}

}  // namespace wormdrive
