#include "diagnosis/experiment/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "control/pid.hpp"
#include "description/build_control.hpp"
#include "description/tables.hpp"
#include "diagnosis/data/needed_torque.hpp"
#include "diagnosis/rules/verdict.hpp"
#include "statistics/robust.hpp"

namespace wormdrive {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The way between all stops that a scenario states.
MotionLimits between_stops(const Scenario& scenario) {
  MotionLimits way{infinite, infinite, -infinite, infinite};
  for_each_table(scenario, [&](const TablePlace&, const auto& table) {
    using Table = std::decay_t<decltype(table)>;
    if constexpr (std::is_same_v<Table, EndStops> || std::is_same_v<Table, HardStops<double>>) {
      if (table.low) way.low = std::max(way.low, *table.low);
      if (table.high) way.high = std::min(way.high, *table.high);
    }
  });
  return way;
}

void keep_off_stops(MotionLimits& limits, const Scenario& scenario) {
  const MotionLimits way = between_stops(scenario);
  limits.low = std::max(limits.low, way.low);
  limits.high = std::min(limits.high, way.high);
  const double spare = rules::beside_stops * limits.half();
  limits.low = std::max(limits.low, way.low + spare);
  limits.high = std::min(limits.high, way.high - spare);
}

}  // namespace

MotionLimits allowed_range(const Scenario& scenario, const std::vector<PreparedRecording>& recordings,
                           bool load_turns) {
  MotionLimits range{0.0, 0.0, infinite, -infinite};
  for (const PreparedRecording& r : recordings) {
    const std::vector<double>& angle = r.data.gear_angle;
    const auto [low, high] = std::minmax_element(angle.begin(), angle.end());
    range.low = std::min(range.low, *low);
    range.high = std::max(range.high, *high);
    range.torque = std::max(range.torque, rules::torque_beyond * usual_peak(r.data.motor_torque));
    const double period = r.data.period;
    range.speed = std::max(
        range.speed, rules::speed_beyond * usual_peak(measured_motion(angle, period, slope_half_width(period)).speed));
  }
  if (load_turns) {
    range.low = std::min(range.low, -rules::either_way_of_load);
    range.high = std::max(range.high, rules::either_way_of_load);
  }
  keep_off_stops(range, scenario);
  const ExperimentLimits stated = scenario.limits.value_or(ExperimentLimits{});
  range.torque = stated.torque.value_or(range.torque);
  range.speed = stated.speed.value_or(range.speed);
  range.low = stated.low.value_or(range.low);
  range.high = stated.high.value_or(range.high);
  return range;
}

double highest_frequency(double period) { return rules::cycles_per_sample / period; }

ControlScenario following(const Scenario& scenario, const ProbingMotion& motion, const MotionLimits& range,
                          double period) {
  ControlScenario control;
  control.sampling.period = period;
  PidParameters pid;
  const double pole = rules::pole_per_sample / period;
  Scenario sampled = scenario;
  sampled.control = control;
  const double M = mean_inertia(make_nominal(sampled));
  pid.integral_weight = M * M * std::pow(pole, 6);
  pid.feedforward = 1.0;
  control.law = pid;
  // the sweep begins where the drive stands
  const double centre = 0.5 * (range.low + range.high), start = scenario.initial.theta_g;
  const double phase = std::asin(std::clamp((start - centre) / motion.amplitude, -1.0, 1.0));
  control.reference.terms = {
      SinusoidReference{.amplitude = motion.amplitude, .frequency = motion.frequency, .phase = phase},
      MultisineReference{.amplitude = motion.fast_amplitude,
                         .lowest_frequency = rules::lowest_sine * motion.fastest,
                         .highest_frequency = motion.fastest,
                         .count = 7}};
  if (centre != 0.0) control.reference.terms.emplace_back(StepReference{.angle = centre, .time = 0.0});
  control.sensor.filter_cutoff = 0.1 / period;
  return control;
}

MotionLimits reached(const Recording& recording, const Reference& reference) {
  MotionLimits r{0.0, 0.0, infinite, -infinite};
  for (std::size_t k = 0; k < recording.samples(); ++k) {
    r.torque = std::max(r.torque, std::abs(recording.motor_torque[k]));
    r.speed = std::max(r.speed, std::abs(reference.at(recording.time(k)).speed));
    r.low = std::min(r.low, recording.gear_angle[k]);
    r.high = std::max(r.high, recording.gear_angle[k]);
  }
  return r;
}

}  // namespace wormdrive
