#include "simulation/lane_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/elastic/elastic_teeth.hpp"
#include "simulation/run_drive.hpp"

namespace wormdrive {
namespace {

/// Whether lanes may know the drive, whatever loads it and limits its torque.
bool has_held_torque(const Scenario& scenario) {
  const Effects<double>& on = scenario.effects;
  return scenario.run.solver == SolverKind::taylor && std::holds_alternative<MeshParameters<double>>(scenario.mesh) &&
         scenario.motor.terms.empty() && !has_elastic_teeth(on) && !on.have_states() && on.delay() <= 0.0 &&
         on.lag() <= 0.0;
}

bool has_lane_load(const Scenario& scenario) {
  const auto* const signal = std::get_if<Signal>(&scenario.load);
  if (!signal) return std::holds_alternative<GravityArm>(scenario.load);
  return std::all_of(signal->terms.begin(), signal->terms.end(),
                     [](const SignalTerm& term) { return std::holds_alternative<Constant>(term); });
}

/// Whether lanes know what a controller is told and how it decides.
bool has_lane_controller(const ControlScenario& control) {
  const SensorSettings& sensor = control.sensor;
  return (std::holds_alternative<SlidingParameters>(control.law) ||
          std::holds_alternative<PidParameters>(control.law)) &&
         control.anti_windup.method == AntiWindup::none && (sensor.zero_error == 0.0 || !sensor.index_mark) &&
         !sensor.exact_speed && !sensor.on_worm;
}

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Of a law for which nothing is promised.
constexpr Lemma1Quiet<double> all_quiet{infinity, infinity, infinity};

/// In the place of a controller.
struct HeldTorque {
  double torque = 0.0, disturbance = 0.0;
  bool held = false;

  bool pause() const { return held; }
  template <class Drive>
  double sample(Drive& drive, const typename Drive::Instant&) {
    held = true;
    drive.disturb(disturbance);
    return torque;
  }
};

template <class Load>
class LaneRunOf final : public LaneRun {
 public:
  using Drive = WormDrive<double, Load>;

  LaneRunOf(const Scenario& scenario, Drive drive)
      : scenario_(scenario),
        drive_(std::move(drive)),
        solver_(drive_, scenario.run.solver_settings()),
        run_(drive_, solver_, scenario, nobody_),
        nominal_(make_nominal(scenario)),
        lemma_(lemma1(nominal_, make_variations(scenario))),
        watch_(scenario.control->window, scenario.control->law, lemma_),
        encoder_(scenario.control->sensor),
        disturbance_(scenario.control->disturbance, scenario.control->sampling.period),
        progress_{run_.timetable(*scenario.control), run_.start(), EventLog()} {}
  LaneRunOf(const LaneRunOf&) = delete;  // solver and run point into it
  LaneRunOf& operator=(const LaneRunOf&) = delete;

  /// False for a drive with a mode whose steps have no closed form.
  bool has_closed_form() const {
    for (const Motion motion : {Motion::forward, Motion::backward})
      for (const Flank flank : {Flank::left, Flank::right})
        if (!solver_.nominal().driven({motion, flank}) || solver_.nominal().rubs({motion, flank}) != rubs())
          return false;
    return true;
  }
  LaneVariant variant() const override {
    return {.ideal = std::isinf(drive_.torque_limit()) && solver_.nominal().response().gain == 1.0 &&
                     scenario_.control->sampling.delay <= 0.5 && is_encoder_exact() && !is_disturbed(),
            .pid = std::holds_alternative<PidParameters>(scenario_.control->law),
            .swings = std::is_same_v<Load, GravityLoad>,
            .rubs = rubs()};
  }
  bool estimate_is_aligned() const override { return nominal_.load_angle_offset == 0.0 && is_encoder_exact(); }
  bool is_rough() const override { return !encoder_.is_exact() || scenario_.control->sensor.zero_error != 0.0; }
  bool is_noisy() const override { return scenario_.control->sensor.noise > 0.0; }
  bool is_disturbed() const override { return scenario_.control->disturbance.deviation > 0.0; }
  void draw(long first, long end, std::size_t stride, double* noise, double* disturbance) override {
    for (long k = first; k < end; ++k) {
      const auto sample = static_cast<std::uint64_t>(k);
      const std::size_t at = static_cast<std::size_t>(k - first) * stride;
      if (noise) noise[at] = is_noisy() ? encoder_.noise(sample) : -0.0;  // which changes no angle, not even 0
      if (disturbance) disturbance[at] = disturbance_(sample);
    }
  }

  void start(const Lane& lane) override {
    advance({.held = true});
    const ControlScenario& control = *scenario_.control;
    const auto* const scale = effect<EncoderScale<double>>();
    const auto* const offset = effect<EncoderOffset<double>>();
    const double zero_error = control.sensor.zero_error;
    LaneTrial<double> trial{.sliding = {},
                            .pid = {},
                            .load_torque = nominal_.load_torque,
                            .load_angle_offset = nominal_.load_angle_offset,
                            .load_constant = nominal_.load_constant,
                            .encoder_share = scale ? scale->share : 0.0,
                            .encoder_zero = offset ? offset->angle : -0.0,  // which changes no angle, not even 0
                            .count = encoder_.count(),
                            .zero_error = zero_error != 0.0 ? zero_error : -0.0,
                            .speed = {control.sensor.filter_cutoff, control.sampling.period},
                            .sums = watch_.meter.sums(),
                            .quiet = watch_.lemma ? watch_.lemma->quiet() : all_quiet,
                            .limit = drive_.torque_limit(),
                            .left = 0.0,
                            .drive = {},
                            .arm_offset = solver_.nominal().arm_offset(),
                            .theta = 0.0,
                            .omega = 0.0};
    if (const auto* const sliding = std::get_if<SlidingParameters>(&control.law))
      trial.sliding = {*sliding, nominal_, SlidingBounds(*sliding, lemma_)};
    if (const auto* const pid = std::get_if<PidParameters>(&control.law))
      trial.pid = {lqr_gains(*pid, mean_inertia(nominal_)), *pid, nominal_};
    leave(trial);
    trial.speed.start(encoder_(drive_.measured_angle(progress_.now), 0));
    lane.write(trial);
  }

  void go_on(const Lane& lane, long sample, double t, double torque, double disturbance) override {
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
    advance({.torque = torque, .disturbance = disturbance});
    next_ = sample + 1;
    leave(trial);
    lane.write(trial);
  }

  void note(const Lane& lane, const ControlRecord& record) override {
    const bool was_reached = !std::isnan(watch_.lemma->reached());
    watch_.lemma->sample(record);
    if (was_reached || std::isnan(watch_.lemma->reached())) return;
    LaneTrial<double> trial = lane.read();
    trial.quiet = watch_.lemma->quiet();
    lane.write(trial);
  }

  RunSummary finish(const Lane& lane, long samples) override {
    watch_.meter.sampled(lane.read().sums, samples);
    return run_.finish(watch_);
  }

 private:
  template <class Effect>
  const Effect* effect() const {
    const auto& found = std::get<std::optional<Effect>>(drive_.effects().list);
    return found ? &*found : nullptr;
  }
  bool is_encoder_exact() const {
    return !is_rough() && !effect<EncoderScale<double>>() && !effect<EncoderOffset<double>>();
  }
  bool rubs() const { return solver_.nominal().rubs({Motion::forward, Flank::left}); }

  void advance(HeldTorque torque) {
    wormdrive::go_on(drive_, solver_, torque, progress_,
                     [this](const Drive& drive, const typename Drive::Instant& now) {
                       watch_.meter.instant(now.t, now.mode);
                       run_.record(drive, now);
                     });
  }

  /// Leaves state and mode to the lane; at rest, with motion 0, no step is known beforehand.
  void leave(LaneTrial<double>& trial) const {
    const typename Drive::Instant& now = progress_.now;
    trial.theta = now.x[0];
    trial.omega = now.x[1];
    trial.drive = Drive::at_rest(now.mode) ? DrivenMotion{} : *solver_.nominal().driven(now.mode);
  }

  using Solver = TaylorSolver<Drive>;

  const Scenario& scenario_;
  RunListeners nobody_;
  Drive drive_;
  Solver solver_;
  DriveRun<Drive, Solver> run_;
  NominalModel nominal_;
  Lemma1 lemma_;
  ControlWatch watch_;
  Encoder encoder_;
  TorqueDisturbance disturbance_;
  Progress<Drive> progress_;
  long next_ = 0;  ///< sample up to which it has come alone
};

template <class Stated>
std::unique_ptr<LaneRun> lane_run(const Scenario& scenario, const Stated& load) {
  auto drive = make_drive(scenario, load, scenario.effects, scenario.motor);
  using Load = std::decay_t<decltype(drive.load())>;
  auto run = std::make_unique<LaneRunOf<Load>>(scenario, std::move(drive));
  if (!run->has_closed_form()) return nullptr;
  return run;
}

}  // namespace

bool has_lane_plant(const Scenario& scenario) {
  return has_held_torque(scenario) && std::holds_alternative<GravityArm>(scenario.load) &&
         std::isinf(scenario.effects.torque_limit());
}

bool fits_lane(const Scenario& scenario) {
  return scenario.control && has_lane_controller(*scenario.control) && has_held_torque(scenario) &&
         has_lane_load(scenario) && scenario.effects.measuring_delay() <= 0.0;
}

bool share_samples(const Scenario& a, const Scenario& b) {
  if (!a.control || !b.control) return false;
  const SolverSettings x = a.run.solver_settings(), y = b.run.solver_settings();
  return a.control->reference == b.control->reference && a.control->sampling == b.control->sampling &&
         a.control->window == b.control->window && a.run.duration == b.run.duration &&
         x.relative_tolerance == y.relative_tolerance && x.absolute_tolerance == y.absolute_tolerance &&
         x.max_step == y.max_step;
}

std::unique_ptr<LaneRun> lane_run(const Scenario& scenario) {
  if (!fits_lane(scenario)) return nullptr;
  if (const auto* const arm = std::get_if<GravityArm>(&scenario.load)) return lane_run(scenario, *arm);
  return lane_run(scenario, std::get<Signal>(scenario.load));
}

}  // namespace wormdrive
