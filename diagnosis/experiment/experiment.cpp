#include "diagnosis/verdict/experiment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "control/pid.hpp"
#include "core/elastic/elastic_teeth.hpp"
#include "description/build_control.hpp"
#include "description/rejection.hpp"
#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/rules/verdict.hpp"
#include "diagnosis/verdict/certificate.hpp"
#include "events/simulation_failure.hpp"
#include "simulation/run_scenario.hpp"

namespace wormdrive {

namespace {

struct Variant {
  std::string_view what;
  double highest;  ///< frequency [Hz]
  double payload;  ///< times the stated one
};
/// The gentler ones first: fast motions show how teeth yield, of which a predictor with rigid teeth knows nothing.
constexpr Variant variants[] = {{"a motion over a larger angle", 4.0, 1.0},
                                {"a faster motion over a larger angle", 10.0, 1.0},
                                {"a second payload, twice the first", 4.0, 2.0}};

/// A closed loop that follows a slow sweep and several sines with all its poles at one distance from the origin. Steps
/// would let the teeth bounce, which tells more of the teeth than of anything else.
ControlScenario rich_motion(const Scenario& scenario, double angle, double highest, double period) {
  ControlScenario control;
  control.sampling.period = period;
  PidParameters pid;
  constexpr double pole = 40.0;  // [rad/s]
  Scenario told = scenario;
  told.control = control;
  const double M = mean_inertia(make_nominal(told));
  pid.integral_weight = M * M * std::pow(pole, 6);
  pid.feedforward = 1.0;
  control.law = pid;
  control.reference.terms = {
      SinusoidReference{.amplitude = angle, .frequency = 0.045},
      MultisineReference{.amplitude = 0.015 * angle, .lowest_frequency = 0.7, .highest_frequency = highest, .count = 7},
      SinusoidReference{.amplitude = 0.06 * angle, .frequency = 1.5}};
  control.sensor.filter_cutoff = 0.1 / period;
  return control;
}

/// Angle of the slow sweep where the load turns with the gear: it pulls either way, and not at all [rad].
constexpr double quarter_turn_and_more = 2.2;

bool multiply_payload(Scenario& scenario, double factor) {
  if (factor == 1.0) return true;
  auto* arm = std::get_if<GravityArm>(&scenario.load);
  if (!arm) return false;
  if (arm->mass) *arm->mass *= factor;
  if (arm->amplitude) *arm->amplitude *= factor;
  if (arm->own_inertia) *arm->own_inertia *= factor;
  return true;
}

}  // namespace

Recording simulated(const Scenario& scenario) {
  Recording recording;
  recording.period = scenario.control->sampling.period;
  RunListeners listeners;
  listeners.samples = [&](const std::vector<ControlRecord>& samples) {
    for (const ControlRecord& s : samples) {
      recording.motor_torque.push_back(s.decided.torque);
      recording.gear_angle.push_back(s.measured.angle);
    }
  };
  run_scenario(scenario, listeners);
  recording.valid.assign(recording.samples(), 1);
  const double counts = scenario.control->sensor.counts;
  recording.gear_resolution = counts > 0.0 ? 2.0 * std::numbers::pi / counts : 0.0;
  return recording;
}

Experiment splitting_experiment(const Scenario& extended, const Scenario& stated, const std::vector<Candidate>& members,
                                double size, const std::vector<Coordinate>& toleranced, const Magnitudes& sizes,
                                double excursion, int threads) {
  Experiment best;
  double best_margin = 1.0;  // sizes that could be named
  for (const Variant& v : variants) {
    if (best_margin >= rules::ample_margin) break;
    Scenario run = extended, told = stated;
    if (!multiply_payload(run, v.payload) || !multiply_payload(told, v.payload)) continue;
    const double angle = sizes.load_turns ? quarter_turn_and_more : excursion;
    run.control = rich_motion(stated, angle, v.highest, sizes.period);
    run.control->sensor.counts = 65536.0;
    run.control->disturbance.deviation = 0.01 * sizes.torque;
    run.run.duration = 24.0;
    run.run.relative_tolerance = 1e-9;
    told.control = run.control;
    told.run = run.run;
    for (Scenario* each : {&run, &told})
      each->run.solver = has_elastic_teeth(each->effects) ? SolverKind::cvode : SolverKind::taylor;
    if (why_it_cannot_run(told) || why_it_cannot_run(run)) continue;
    try {
      // signatures are those about what is stated
      const PreparedRecording recording = prepared(simulated(told), 0);
      const Evaluation evaluation(told, InnovationLayout({recording}), threads);
      Hypothesis h = stated_hypothesis(told.effects, toleranced);
      if (!evaluate(evaluation, h)) continue;
      adjust_noise(evaluation, h, 6);
      const std::vector<Visibility> seen =
          certificate(linear_system(evaluation, h, screen(evaluation, h, members)), h, members, sizes);
      if (seen.empty() || seen.front().effect != members.front().effect) continue;
      const double margin = size / seen.front().nameable;
      if (margin <= best_margin) continue;
      best_margin = margin;
      run.control->disturbance.deviation = 0.0;
      run.title = fmt::format("Experiment that tells {} from what looks like it", members.front().effect);
      best.scenario = run;
      best.reason = fmt::format("{}: a {} {:.2g} times smaller could be named", v.what, members.front().effect, margin);
    } catch (const SimulationFailure&) {
      continue;  // a drive that cannot follow this motion needs another one
    }
  }
  if (!best.scenario) best.reason = "none of the motions that were tried out tells them apart";
  return best;
}

}  // namespace wormdrive
