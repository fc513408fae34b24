#pragma once
#include <array>
#include <optional>
#include <vector>

#include "core/worm_drive.hpp"
#include "events/taylor/tapes/leap_by_terms.hpp"

namespace wormdrive {

/// A moment that says what comes from outside [N m]: what the motor is told, what all loads over time come to, what
/// disturbs the worm's shaft, and how the brake holds it.
template <class S>
struct MomentOnTape : Moment<S> {
  S command, load_over_time, disturbance, brake;
};
/// The same with the states of the effects.
template <class S>
struct MomentOfEffectsOnTape : MomentOfEffects<S> {
  S command, load_over_time, disturbance, brake;
};

/// What of a load depends on time alone, or nullptr.
template <class Load>
const TimedLoad* over_time(const Load& load) {
  if constexpr (requires { load.over_time(); })
    return load.over_time();
  else
    return nullptr;
}

/// The equations of a drive in one mode, recorded for good.
template <class System>
class TapeCourse {
 public:
  using Instant = typename System::Instant;
  static constexpr bool has_states = System::state_size > 2;
  static_assert(System::state_size - 2 <= TapeCode::most_states);

  /// They hold while all comparisons turn out as they do at this moment.
  TapeCourse(const System& system, Mode mode, const Instant& now) {
    if constexpr (has_states)
      system.effects().for_each_state([&](const auto&, const auto&, std::size_t k) { states_.push_back(k); });
    record(system, mode, now);
    if (!tape_.is_complete()) return;
    for (const Tape::Decision& decision : tape_.decisions()) {
      if (decision.side == 0.0) return;
      decisions_.push_back(decision.place);
    }
    describe(system);
    lay_out(system, mode);
  }
  TapeCourse(const TapeCourse&) = delete;  // what is in it points to the rest
  TapeCourse& operator=(const TapeCourse&) = delete;

  /// Which states the tape has, by their places among all.
  const std::vector<std::size_t>& states() const { return states_; }

  /// The way to a stop, and the quantities at whose zeros the equations bend.
  const Tape::Multiple& way_to_stop() const { return way_to_stop_; }
  const std::vector<Tape::Multiple>& bends() const { return bends_; }

  TapeCode code;
  std::vector<double> memory;
  std::optional<TapedLeapOf<double>> leap;  ///< nothing where the equations could not be recorded
  TapeTables tables;
  bool command_moves = false;  ///< the series of the command has more than a value

 private:
  using In = TapeInput;

  void record(const System& system, Mode mode, const Instant& now) {
    tape_.clear(In::first_state + static_cast<int>(states_.size()));
    std::array<Taped, System::state_size> x;
    x[0] = tape_.input(In::angle, now.x[0]);
    x[1] = tape_.input(In::speed, now.x[1]);
    for (int k = 2; k < System::state_size; ++k) x[k] = Taped(now.x[k]);  // of an effect that is off
    for (std::size_t k = 0; k < states_.size(); ++k)
      x[2 + states_[k]] = tape_.input(In::first_state + static_cast<int>(k), now.x[2 + states_[k]]);
    const TimedLoad* const timed = over_time(system.load());
    const std::conditional_t<has_states, MomentOfEffectsOnTape<Taped>, MomentOnTape<Taped>> at{
        system.moment_at(tape_.input(In::time, now.t), x), tape_.input(In::command, system.motor_input()(now.t)),
        timed ? tape_.input(In::load, timed->piece(now.t)) : Taped(0.0),
        tape_.input(In::disturbance, system.disturbance()), tape_.input(In::brake, system.effects().braking())};
    const auto tau = system.side_torques(system.inputs(at, mode.motion), at, mode.motion);
    code.acceleration = tape_.place(system.acceleration(tau, at, mode));
    if constexpr (has_states) {
      const auto rates = system.state_rates(at, mode);
      for (const std::size_t k : states_) rates_.push_back(tape_.place(rates[k]));
    }
    code.of_acceleration = static_cast<int>(tape_.steps().size());
    code.beyond = tape_.place(system.beyond_surface(tau, at));
    code.worm = tape_.place(tau.worm);
    code.gear = tape_.place(tau.gear);
    if constexpr (has_states) {
      const Taped way = system.guards(at, mode)[System::stop_guard];
      tape_.decide_by(way);
      way_to_stop_ = Tape::multiple(way);
    }
    system.for_each_bend(at, mode.motion, [this](const Taped& bend) {
      tape_.decide_by(bend);
      bends_.push_back(Tape::multiple(bend));
    });
  }
  void describe(const System& system) {
    code.steps = tape_.steps().data();
    code.operations = static_cast<int>(tape_.steps().size());
    code.places = tape_.places();
    code.states = static_cast<int>(states_.size());
    code.rates = rates_.data();
    code.arguments = tape_.arguments().data();
    code.sections = static_cast<int>(tape_.arguments().size());
    code.decisions = decisions_.data();
    code.comparisons = static_cast<int>(decisions_.size());
    code.exponents = tape_.exponents().data();
    code.exponentials = static_cast<int>(tape_.exponents().size());
    code.lags = system.motor_input().lags();
    if (const TimedLoad* const timed = over_time(system.load()))
      code.waves = static_cast<int>(timed->signal.terms.size());
  }
  /// Puts the numbers of the tape and the mode into memory.
  void lay_out(const System& system, Mode mode) {
    memory.assign(TapeSeriesOf<double>::room(code), 0.0);
    leap.emplace(TapeSeriesOf<double>(code, memory.data()));
    TapeSeriesOf<double>& series = leap->series();
    put_constants(series);
    for (int k = 0; k < code.comparisons; ++k) {
      const Tape::Decision& decision = tape_.decisions()[static_cast<std::size_t>(k)];
      series.side(k) = {decision.value, decision.side};
    }
    TapedMotionOf<double>& motion = series.motion();
    motion.motion = sign(mode.motion);
    motion.flank = sign(mode.flank);
    motion.surface = system.surface();
    tables = TapeTables(tape_, series);
  }

  Tape tape_{0};
  std::vector<std::size_t> states_;
  std::vector<int> rates_, decisions_;
  Tape::Multiple way_to_stop_{};
  std::vector<Tape::Multiple> bends_;
};

}  // namespace wormdrive
