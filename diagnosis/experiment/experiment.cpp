#include "diagnosis/experiment/experiment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/format.h>
#include <nlopt.h>

#include "core/elastic/elastic_teeth.hpp"
#include "description/rejection.hpp"
#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/rules/verdict.hpp"
#include "diagnosis/verdict/certificate.hpp"
#include "diagnosis/verdict/verdict.hpp"
#include "events/simulation_failure.hpp"
#include "simulation/run_scenario.hpp"

namespace wormdrive {

namespace {

/// Coordinates of a motion, each from 0 to 1: amplitude and frequency of the sweep, those of the fast sines.
using Point = std::array<double, 4>;

bool multiply_payload(Scenario& scenario, double factor) {
  if (factor == 1.0) return true;
  auto* arm = std::get_if<GravityArm>(&scenario.load);
  if (!arm) return false;
  if (arm->mass) *arm->mass *= factor;
  if (arm->amplitude) *arm->amplitude *= factor;
  if (arm->own_inertia) *arm->own_inertia *= factor;
  return true;
}

/// Looks for the best motion with one payload.
class MotionSearch {
 public:
  MotionSearch(const Question& question, const MotionLimits& range, double payload, int threads)
      : question_(question), range_(range), threads_(threads), run_(question.found), stated_(question.stated) {
    possible_ = multiply_payload(run_, payload) && multiply_payload(stated_, payload);
    const Magnitudes& sizes = question.sizes;
    for (Scenario* each : {&run_, &stated_}) {
      each->initial.theta_g = std::clamp(each->initial.theta_g, range.low, range.high);
      each->initial.omega_g = 0.0;
      each->run.duration = std::min(sizes.duration, rules::most_of_experiment * sizes.period);
      each->run.relative_tolerance = 1e-9;
      each->run.solver = has_elastic_teeth(each->effects) ? SolverKind::cvode : SolverKind::taylor;
    }
  }

  /// Tries motions out, from one on that stays within the speed.
  void search() {
    if (!possible_) return;
    allow_slow_sweep();
    const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> optimiser(nlopt_create(NLOPT_LN_COBYLA, Point{}.size()),
                                                                      nlopt_destroy);
    nlopt_set_lower_bounds1(optimiser.get(), 0.0);
    nlopt_set_upper_bounds1(optimiser.get(), 1.0);
    nlopt_set_initial_step1(optimiser.get(), 0.25);
    nlopt_set_maxeval(optimiser.get(), rules::most_motions);
    nlopt_set_xtol_abs1(optimiser.get(), 0.02);
    nlopt_set_max_objective(
        optimiser.get(),
        [](unsigned, const double* x, double*, void* self) {
          return static_cast<MotionSearch*>(self)->tried({x[0], x[1], x[2], x[3]}).worth;
        },
        this);
    nlopt_add_inequality_mconstraint(
        optimiser.get(), static_cast<unsigned>(Trial{}.beyond.size()),
        [](unsigned, double* result, unsigned, const double* x, double*, void* self) {
          const Trial& trial = static_cast<MotionSearch*>(self)->tried({x[0], x[1], x[2], x[3]});
          std::copy(trial.beyond.begin(), trial.beyond.end(), result);
        },
        this, nullptr);
    optimiser_ = optimiser.get();
    Point start = within_speed(with_fast_sines);
    const double worth = tried(start).worth;
    if (const Point other = within_speed(nearly_alone); tried(other).worth > worth) start = other;
    if (margin >= rules::ample_margin) return;
    double best = 0.0;
    nlopt_optimize(optimiser.get(), start.data(), &best);
  }

  double margin = 0.0;  ///< sizes of the first contender that the best motion could tell within one as it was found
  Visibility seen{};    ///< the first contender by the best motion
  Scenario experiment;  ///< with the best motion
  MotionLimits asks{};  ///< what it asks of the drive

 private:
  /// What came of a motion.
  struct Trial {
    double worth = std::log(least_margin);             ///< logarithm of the margin
    std::array<double, 4> beyond{1.0, 1.0, 1.0, 1.0};  ///< torque, speed, angles; positive: it goes too far
  };
  static constexpr double least_margin = 1e-6;
  static constexpr Point with_fast_sines{0.97, 0.03, 0.55, 0.6}, nearly_alone{1.0, 0.0, 0.1, 0.6};
  static constexpr double least_amplitude = 0.05;  ///< as a share of the range

  /// The same motion with an amplitude, to which its speed is proportional, that the speed allows.
  Point within_speed(Point u) {
    const double beyond = tried(u).beyond[1];
    if (beyond > 0.0) u[0] = std::max(0.0, u[0] + std::log(1.01 * (1.0 + beyond)) / std::log(least_amplitude));
    return u;
  }

  ProbingMotion motion(const Point& u) const {
    const auto between = [](double low, double high, double share) { return low * std::pow(high / low, share); };
    ProbingMotion m{};
    const double once = 1.0 / stated_.run.duration, fastest = highest_frequency(question_.sizes.period);
    m.amplitude = range_.half() * between(least_amplitude, 1.0, u[0]);
    m.frequency = between(once, std::max(once, 0.25 * fastest), u[1]);
    m.fast_amplitude = m.amplitude * between(1e-3, 0.1, u[2]);
    m.fastest = between(std::min(4.0 * m.frequency, fastest), fastest, u[3]);
    return m;
  }

  /// Where no torque is stated, what a slow sweep through the whole range takes is allowed, and as much again for what
  /// is faster.
  void allow_slow_sweep() {
    if (question_.stated.limits && question_.stated.limits->torque) return;
    const ProbingMotion slow{range_.half(), 1.0 / stated_.run.duration, 0.0, highest_frequency(question_.sizes.period)};
    if (const auto recording = recorded(stated_, slow))
      range_.torque =
          std::max(range_.torque, rules::torque_beyond * reached(*recording, stated_.control->reference).torque);
  }

  /// What a scenario writes down when it follows a motion; nothing where it cannot.
  std::optional<Recording> recorded(Scenario& scenario, const ProbingMotion& motion) const {
    scenario.control = following(question_.stated, motion, range_, question_.sizes.period);
    scenario.control->sensor.counts = question_.counts;
    scenario.control->disturbance.deviation = question_.noise_torque;
    if (why_it_cannot_run(scenario)) return std::nullopt;
    try {
      return simulated(scenario);
    } catch (const SimulationFailure&) {
      return std::nullopt;  // a drive that cannot follow this motion needs another one
    }
  }

  const Trial& tried(const Point& u) {
    if (u == last_point_) return last_;
    last_point_ = u;
    last_ = trial(u);
    return last_;
  }

  Trial trial(const Point& u) {
    Trial t;
    const ProbingMotion m = motion(u);
    // signatures are those about what is stated
    const std::optional<Recording> recording = recorded(stated_, m);
    if (!recording) return t;
    const MotionLimits went = reached(*recording, stated_.control->reference);
    t.beyond = {went.torque / range_.torque - 1.0, went.speed / range_.speed - 1.0,
                (range_.low - went.low) / range_.half() - rules::beside_range,
                (went.high - range_.high) / range_.half() - rules::beside_range};
    const std::optional<Visibility> visible = shown(*recording);
    const double found = visible ? margin_of(*visible) : 0.0;
    t.worth = std::log(std::max(least_margin, visible ? worth_of(*visible) : 0.0));
    if (found <= margin || std::any_of(t.beyond.begin(), t.beyond.end(), [](double x) { return x > 0.0; })) return t;
    if (!recorded(run_, m)) return t;
    margin = found;
    seen = *visible;
    experiment = run_;
    asks = went;
    if (margin >= rules::ample_margin) nlopt_force_stop(optimiser_);
    return t;
  }

  /// What a recording can show of the first contender beside the others; nothing if none of it.
  std::optional<Visibility> shown(const Recording& recording) const {
    const std::vector<Candidate>& contenders = question_.contenders;
    const Evaluation evaluation(stated_, InnovationLayout({prepared(recording, 0)}), threads_);
    Hypothesis h = stated_hypothesis(stated_.effects, question_.toleranced);
    if (!evaluate(evaluation, h)) return std::nullopt;
    adjust_noise(evaluation, h, 6);
    const std::vector<Visibility> all =
        certificate(linear_system(evaluation, h, screen(evaluation, h, contenders)), h, contenders, question_.sizes);
    if (all.empty() || all.front().effect != contenders.front().effect || !all.front().observable) return std::nullopt;
    return all.front();
  }

  double margin_of(const Visibility& v) const {
    const Candidate& first = question_.contenders.front();
    const bool less_is_more = first.is_limit || first.coordinates[0].form == CoordinateForm::inverse;
    return less_is_more ? v.resolved / question_.size : question_.size / v.resolved;
  }

  /// The same, or where the contenders are too alike to be told apart, how near they are to that: a search would not
  /// know where to go if all such motions were worth nothing.
  double worth_of(const Visibility& v) const {
    if (std::isfinite(v.resolved) && v.resolved > 0.0) return margin_of(v);
    const double share = 1.0 - v.likeness;
    return std::min(1.0, share / rules::nameable_share);
  }

  const Question& question_;
  MotionLimits range_;
  int threads_;
  Scenario run_, stated_;  ///< the drive as it was found and as it is stated, with this payload
  bool possible_ = false;
  nlopt_opt optimiser_ = nullptr;
  Point last_point_{-1.0, -1.0, -1.0, -1.0};
  Trial last_;
};

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

Experiment best_experiment(const Question& question, const MotionLimits& range, int threads) {
  Experiment best;
  double margin = 1.0;  // sizes that could be named
  std::vector<std::string> others;
  for (std::size_t k = 1; k < question.contenders.size(); ++k)
    others.push_back(in_words(std::string(question.contenders[k].effect)));
  for (const double payload : {1.0, 2.0}) {
    if (range.low >= range.high || margin >= rules::ample_margin) break;
    MotionSearch motions(question, range, payload, threads);
    motions.search();
    if (motions.margin <= margin) continue;
    margin = motions.margin;
    best.scenario = std::move(motions.experiment);
    best.scenario->control->disturbance.deviation = 0.0;
    best.scenario->title = fmt::format("Experiment that tells {} from what looks like it",
                                       in_words(std::string(question.contenders.front().effect)));
    const Visibility& v = motions.seen;
    const Axis axis = question.stated.axis;
    const auto in = [axis](const char* rotary) { return units_on(axis, rotary); };
    best.reason =
        fmt::format("{}motion from {:.3g} to {:.3g} {} with up to {:.2g} {} and {:.2g} {}; {} could be told from {}",
                    payload == 1.0 ? "a " : "a second payload, twice the first, and a ", motions.asks.low,
                    motions.asks.high, in("rad"), motions.asks.speed, in("rad/s"), motions.asks.torque, in("N m"),
                    phrase({v.effect, {{v.field, v.unit, v.nameable}}}, axis), joined(others, "and"));
  }
  if (!best.scenario) best.reason = "no motion that the drive may be asked for tells them apart";
  return best;
}

}  // namespace wormdrive
