#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "simulation/lanes/held_torque.hpp"
#include "simulation/lanes/lane_run.hpp"
#include "simulation/lanes/lane_tape.hpp"
#include "simulation/lanes/lane_trial.hpp"
#include "simulation/run_drive.hpp"

namespace wormdrive {

/// What a load over time consists of.
template <class Term>
bool has_term(const Signal& load) {
  return std::any_of(load.terms.begin(), load.terms.end(),
                     [](const SignalTerm& term) { return std::holds_alternative<Term>(term); });
}
inline bool is_constant(const Signal& load) {
  return std::all_of(load.terms.begin(), load.terms.end(),
                     [](const SignalTerm& term) { return std::holds_alternative<Constant>(term); });
}

/// The run of a drive in a lane.
template <class Drive>
class LaneRunOf final : public LaneRun {
 public:
  using Load = std::decay_t<decltype(std::declval<Drive>().load())>;

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
        progress_{run_.timetable(*scenario.control), run_.start(), EventLog()},
        taped_(!has_closed_form()) {}
  LaneRunOf(const LaneRunOf&) = delete;  // solver and run point into it
  LaneRunOf& operator=(const LaneRunOf&) = delete;

  /// False where the steps of the drive are neither in closed form nor on a tape.
  bool fits() { return !taped_ || (response() != MotorResponse::after_delay && leaps_by_tape() && tape() != nullptr); }
  LaneVariant variant() const override {
    const bool pid = std::holds_alternative<PidParameters>(scenario_.control->law);
    if constexpr (has_formulas)
      if (!taped_)
        return {.ideal = std::isinf(drive_.torque_limit()) && solver_.nominal().response().gain == 1.0 && !falls() &&
                         scenario_.control->sampling.delay <= 0.5 && is_encoder_exact() && !is_disturbed() &&
                         response() == MotorResponse::at_once,
                .pid = pid,
                .swings = std::is_same_v<Load, GravityLoad>,
                .rubs = rubs() && !falls(),
                .falls = solver_.nominal().curve().exponent(),
                .falls_with_tail = solver_.nominal().curve().has_tail(),
                .response = response()};
    return {.ideal = false, .pid = pid, .swings = false, .taped = true};
  }
  const TapeCode* tape() override {
    if (!taped_) return nullptr;
    for (const Motion motion : {Motion::forward, Motion::backward})
      for (const Flank flank : {Flank::left, Flank::right, Flank::none})
        if (const TapeCode* const code = solver_.taped().code(setting_off({motion, flank}))) return code;
    return nullptr;
  }
  void use_tape(const TapeCode& code, double* numbers, double* across, int lanes) override {
    tape_ = LaneTape(code, numbers, lanes);
    tape_across_ = LaneTape(code, across, lanes);
  }
  SectionOf<double> section(int table, double x) override { return solver_.taped().section(table, x); }
  bool estimate_is_aligned() const override { return nominal_.load_angle_offset == 0.0 && is_encoder_exact(); }
  bool is_rough() const override { return !encoder_.is_exact() || scenario_.control->sensor.zero_error != 0.0; }
  bool is_late() const override { return drive_.effects().measuring_delay() > 0.0; }
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
    HeldTorque before{.held = true};
    advance(before);
    LaneTrial<double> trial =
        lane_trial(*scenario_.control, drive_.effects(), nominal_, lemma_, watch_, drive_.torque_limit());
    if constexpr (has_formulas) {
      trial.arm_offset = solver_.nominal().arm_offset();
      if (falls()) trial.per_speed = solver_.nominal().fall({Motion::forward, Flank::left}).per_speed;
    }
    leave(trial, before);
    trial.speed.start(encoder_(drive_.effects().measured_angle(trial.latched), 0));
    lane.write(trial);
  }

  void go_on(const Lane& lane, long sample, double t, double torque, double disturbance) override {
    LaneTrial<double> trial = lane.read();
    if (sample != next_) {
      long restarts = sample - next_, leaps = restarts;
      if (taped_) leaps = static_cast<long>(tape_.motion().leaps);
      if (response() == MotorResponse::after_delay) leaps = restarts *= 2;
      if (response() != MotorResponse::at_once) drive_.resume_motor(t, trial.torque);
      solver_.count_leaps(restarts, leaps);
      take_up_flank_changes(trial);
      progress_.timetable.skip_to_sample(sample);
      progress_.now.t = t;
      progress_.now.x[0] = trial.theta;
      progress_.now.x[1] = trial.omega;
      if constexpr (has_states)
        for (int k = 0; k < states(); ++k) state(k) = tape_.state(k);
      progress_.cause = {Reason::sample};
      watch_.meter.instant(t, progress_.now.mode);
      run_.record(drive_, progress_.now);
    }
    HeldTorque held{.torque = torque, .disturbance = disturbance};
    advance(held);
    next_ = sample + 1;
    leave(trial, held);
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
    LaneTrial<double> trial = lane.read();
    take_up_flank_changes(trial);
    watch_.meter.sampled(trial.sums, samples);
    return run_.finish(watch_);
  }

 private:
  template <class Effect>
  const Effect* effect() const {
    const auto& found = std::get<std::optional<Effect>>(drive_.effects().list);
    return found ? &*found : nullptr;
  }
  bool is_encoder_exact() const {
    return !is_rough() && !is_late() && !effect<EncoderScale<double>>() && !effect<EncoderOffset<double>>();
  }
  using Solver = TaylorSolver<Drive>;
  static constexpr bool has_formulas = NominalFlow<Drive>::known, has_states = Drive::state_size > 2;

  bool rubs() const { return solver_.nominal().rubs({Motion::forward, Flank::left}); }
  bool falls() const { return solver_.nominal().curve().falls(); }
  /// Whether steps are in closed form in every mode.
  bool has_closed_form() const {
    if constexpr (has_formulas) {
      if constexpr (std::is_same_v<Load, TimedLoad>)
        if (!is_constant(drive_.load().signal)) return false;
      for (const Motion motion : {Motion::forward, Motion::backward})
        for (const Flank flank : {Flank::left, Flank::right})
          if (!solver_.nominal().driven({motion, flank}) || solver_.nominal().rubs({motion, flank}) != rubs())
            return false;
      return true;
    }
    return false;
  }
  MotorResponse response() const {
    if (drive_.effects().delay() > 0.0) return MotorResponse::after_delay;
    return drive_.motor_input().lags() ? MotorResponse::with_lag : MotorResponse::at_once;
  }
  /// Whether the solver takes no step in closed form.
  bool leaps_by_tape() const {
    if constexpr (!has_formulas) return true;
    if constexpr (has_formulas)
      if (!solver_.nominal().covers()) return true;
    if constexpr (std::is_same_v<Load, TimedLoad>) return has_term<Sinusoid>(drive_.load().signal);
    return false;
  }

  /// The drive just after it has set off in a mode: there comparisons turn out as they mostly do, and are no ties.
  typename Drive::Instant setting_off(Mode mode) const {
    constexpr double barely = 1e-100;  // a direction, and no speed
    const double way = sign(mode.motion), ahead = way * std::numeric_limits<double>::infinity();
    typename Drive::Instant now = progress_.now;
    now.mode = mode;
    now.t += 0.5 * scenario_.control->sampling.period;
    now.x =
        starting_state(drive_, {std::nextafter(scenario_.initial.theta_g, ahead) + way * barely, way * barely}, 0.0);
    return now;
  }
  /// Of the states that the tape has, how many there are, and one of them.
  int states() { return static_cast<int>(solver_.taped().states().size()); }
  double& state(int k) {
    return progress_.now.x[static_cast<int>(2 + solver_.taped().states()[static_cast<std::size_t>(k)])];
  }

  void advance(HeldTorque& torque) {
    wormdrive::go_on(drive_, solver_, torque, progress_,
                     [this](const Drive& drive, const typename Drive::Instant& now) {
                       watch_.meter.instant(now.t, now.mode);
                       run_.record(drive, now);
                     });
  }

  /// The flank changes that the lane has seen since it was left alone.
  void take_up_flank_changes(LaneTrial<double>& trial) {
    const auto changes = static_cast<long>(trial.flank_changes);
    if (changes == 0) return;
    watch_.meter.changed_flank(static_cast<long>(trial.counted_flank_changes));
    run_.changed_flank(changes);
    trial.flank_changes = trial.counted_flank_changes = 0.0;
    if (changes % 2 == 0) return;
    progress_.now.mode = Drive::across_surface(progress_.now.mode);
    if (taped_) tape_.exchange(tape_across_);
  }

  /// Leaves state and modes to the lane; at rest, with motion 0, no step is known beforehand.
  void leave(LaneTrial<double>& trial, const HeldTorque& held) {
    const typename Drive::Instant& now = progress_.now;
    trial.theta = now.x[0];
    trial.latched = is_late() ? held.latched : trial.theta;
    trial.omega = now.x[1];
    if (response() != MotorResponse::at_once) trial.torque = drive_.motor_input()(now.t);
    const Mode across = Drive::across_surface(now.mode);
    if (taped_) {
      const auto leave_at = [&](LaneTape& tape, Mode mode) {
        typename Drive::Instant then = now;
        then.mode = mode;
        tape.leave(Drive::at_rest(mode) ? nullptr : solver_.taped().code(then),
                   [&] { return solver_.taped().numbers(drive_.next_knot(now.t)); });
      };
      leave_at(tape_across_, across);
      leave_at(tape_, now.mode);
      if constexpr (has_states)
        for (int k = 0; k < states(); ++k) tape_.state(k) = state(k);
      return;
    }
    trial.mode = in_closed_form(now.mode);
    trial.across = in_closed_form(across);
  }
  LaneMode in_closed_form(Mode mode) const {
    if constexpr (has_formulas) {
      if (Drive::at_rest(mode)) return {};
      const FallOf<double>& fall = solver_.nominal().fall(mode);
      return {*solver_.nominal().driven(mode), fall.pull, fall.bend};
    }
    return {};
  }

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
  bool taped_;
  LaneTape tape_, tape_across_;  ///< of the present mode, and of the one across the switching surface
};

/// The run of a scenario's drive, which must outlive it; nothing where it does not fit into a lane.
template <class Drive>
std::unique_ptr<LaneRun> lane_run_of(const Scenario& scenario, Drive drive) {
  auto run = std::make_unique<LaneRunOf<Drive>>(scenario, std::move(drive));
  if (!run->fits()) return nullptr;
  return run;
}

/// The same with the states of its effects.
std::unique_ptr<LaneRun> lane_run_with_states(const Scenario& scenario);

}  // namespace wormdrive
