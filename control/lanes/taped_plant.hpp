#pragma once
#include <array>
#include <limits>

#include "control/lanes/angles.hpp"
#include "control/lanes/batch.hpp"
#include "core/numbers/exponential.hpp"
#include "events/taylor/tapes/leap_by_terms.hpp"
#include "events/taylor/tapes/operations.hpp"

// Included by one file for each instruction set, as kernel.hpp is.

namespace wormdrive {

/// The step of trials of one register whose equations are on tapes.
template <class Width>
class TapedPlant {
 public:
  using V = Lanes<Width>;
  using Mask = LaneMask<Width>;

  TapedPlant(const LaneBatch& batch, int r)
      : batch_(batch),
        r_(r),
        leap_(TapeSeriesOf<V>(*batch.tapes.code, batch.tapes.memory + static_cast<std::size_t>(r) * batch.tapes.room)) {
  }

  /// Moves angle and speed on to the next sample where that is certain beforehand, and returns where it is.
  [[gnu::always_inline]] Mask step(const LaneSample& sample, LaneTrial<V>& x, V& theta, V& omega, const V& command,
                                   const V& disturbance) {
    TapedMotionOf<V>& motion = leap_.series().motion();
    const Mask moves = motion.motion != V(0.0), ahead = V(sample.t + 2.0 * sample.step) < motion.next_knot;
    V t = sample.t, length = sample.step;
    active_ = set_bits(moves & ahead) & batch_.alive[r_];
    MotorTorque motor(*this, x, sample.t, command);
    V taken = motion.leaps, latched = x.latched;
    LaneStates states(leap_.series());
    motor.expand(leap_.series()[TapeInput::command]);
    leap_.begin(t, theta, omega, motor.now(), disturbance, *this);
    const Mask crossed = ahead & leap_.changes_flank();
    const bool crosses = (set_bits(crossed) & batch_.alive[r_]) != 0U;
    if (crosses) [[unlikely]] {
      change_mode(crossed);
      leap_.begin(t, theta, omega, motor.now(), disturbance, *this);
    }
    Mask known = ahead & leap_.goes_on(), going = known;
    for (int leaps = 1;; ++leaps) {
      V end = length;
      Mask leapt = take(going, end);
      if (any(leapt)) {
        leapt = leap_.end_with_sections(leapt, end) & (t + end > t);
        theta = select(leapt, leap_.angle_after(end), theta);
        omega = select(leapt, leap_.speed_after(end), omega);
        states.go_on(leap_, leapt, end);
        if (batch_.is_late) {
          const V latch = sample.next - x.age, then = select(end < length, t + end, V(sample.next));
          const V angle = select(latch < then, leap_.angle_after(latch - t), theta);
          latched = select(leapt & (latch > t) & (latch <= then), angle, latched);
        }
      }
      taken = select(leapt, taken + 1.0, taken);
      known = known & (leapt | (!going));
      going = leapt & (end < length);
      if (!any(going) || leaps == most_leaps) break;
      t = select(going, t + end, t);
      length = select(going, sample.next - t, length);
      active_ = set_bits(going) & batch_.alive[r_];
      states.leave();
      motor.turn_to(t);
      motor.expand(leap_.series()[TapeInput::command]);
      leap_.begin(t, theta, omega, motor.now(), disturbance, *this);
    }
    known = known & (!going);
    active_ = set_bits(known) & batch_.alive[r_];
    if (crosses) [[unlikely]] {
      change_mode(crossed & !known);
      x.count_flank_changes(crossed & known, sample.counts);
    }
    states.end_sample(known);
    motion.leaps = select(known, taken, motion.leaps);
    x.latched = select(known, latched, x.latched);
    motor.end_sample(known, sample.next);
    return known;
  }

  // ---- what the operations on a tape ask for -------------------------------------------------------------------

  [[gnu::always_inline]] SineAndCosineOf<V> sine_and_cosine(const V& x) const {
    return wormdrive::sine_and_cosine<Width>(x, active_, batch_.sine_and_cosine);
  }
  [[gnu::noinline]] V exp(const V& x) const {
    const V found = exponential(x);
    unsigned lanes = set_bits(!((x > V(-707.0)) & (x < V(709.0)))) & active_;
    if (lanes == 0) [[likely]]
      return found;
    EachLane<Width> each(found), arguments(x);
    for (; lanes != 0; lanes &= lanes - 1) {
      const int lane = __builtin_ctz(lanes);
      each.of[lane] = batch_.tapes.exp(arguments.of[lane]);
    }
    return lanes_from<Width>(each.of);
  }
  [[gnu::always_inline]] void find(int table, const V& x) {
    const SectionOf<V>& s = leap_.series().section(table);
    if (const unsigned outside = set_bits(!((s.low <= x) & (x < s.high))) & active_) [[unlikely]]
      find_each(table, x, outside);
  }
  /// A leap never begins where a section ends.
  static constexpr bool turns(int, const V*, int) { return false; }

 private:
  /// The torque that the motors give on a command that they hold: at once, or with a lag.
  class MotorTorque {
   public:
    [[gnu::always_inline]] MotorTorque(const TapedPlant& plant, LaneTrial<V>& trial, double sample, const V& command)
        : plant_(plant),
          trial_(trial),
          lags_(plant.batch_.tapes.code->lags),
          sample_(sample),
          command_(command),
          begin_(trial.torque - command),
          left_(0.0) {
      turn_to(sample);
    }
    [[gnu::always_inline]] void turn_to(const V& t) {
      if (lags_) left_ = begin_ * plant_.exp((sample_ - t) / trial_.behind);
    }
    [[gnu::always_inline]] V now() const { return lags_ ? command_ + left_ : command_; }
    [[gnu::always_inline]] void expand(V* c) const {
      if (lags_) expand_decay(left_, trial_.behind, TapedLeapOf<V>::longest, c);
    }
    /// Keeps what the torque has become at the next sample.
    [[gnu::always_inline]] void end_sample(const Mask& known, double next) {
      if (!lags_) return;
      turn_to(next);
      trial_.torque = select(known, now(), trial_.torque);
    }

   private:
    const TapedPlant& plant_;
    LaneTrial<V>& trial_;
    bool lags_;
    V sample_, command_;
    V begin_, left_;  ///< of the torque before, at the sample and now
  };

  /// The states of effects in the course of a sample, which begin where the series do.
  class LaneStates {
   public:
    explicit LaneStates(TapeSeriesOf<V>& series) : series_(series), count_(series.code().states) {
      for (int k = 0; k < count_; ++k) now_[k] = begin_[k] = first(k);
    }
    void go_on(const TapedLeapOf<V>& leap, const Mask& leapt, const V& seconds) {
      for (int k = 0; k < count_; ++k) now_[k] = select(leapt, leap.state_after(k, seconds), now_[k]);
    }
    /// Leaves them to the series that begin there.
    void leave() {
      for (int k = 0; k < count_; ++k) first(k) = now_[k];
    }
    /// The same for the next sample; where this one is not known, those at its begin.
    void end_sample(const Mask& known) {
      for (int k = 0; k < count_; ++k) first(k) = select(known, now_[k], begin_[k]);
    }

   private:
    V& first(int k) { return series_[TapeInput::first_state + k][0]; }

    TapeSeriesOf<V>& series_;
    int count_;
    std::array<V, TapeCode::most_states> begin_, now_;
  };

  [[gnu::noinline]] Mask take(const Mask& going, V& end) {
    LeapByTerms<V> by_terms(leap_);
    const Mask holds = going & by_terms.holds();
    return any(holds) ? by_terms.take(holds, end, batch_.accuracy, *this) : holds;
  }

  /// Goes over to the modes across the switching surface, or back.
  [[gnu::noinline]] void change_mode(const Mask& which) {
    const TapeCode& code = *batch_.tapes.code;
    V* const numbers = reinterpret_cast<V*>(&leap_.series().motion());
    swap_where<V>(which, numbers, numbers + TapeSeriesOf<V>::room(code), TapeSeriesOf<V>::numbers(code));
  }

  /// Within a sample; what needs more goes on alone.
  static constexpr int most_leaps = 8;

  [[gnu::noinline]] void find_each(int table, const V& x, unsigned lanes) {
    const EachLane<Width> each(x);
    auto* const fields = reinterpret_cast<double*>(&leap_.series().section(table));
    for (; lanes != 0; lanes &= lanes - 1) {
      const int lane = __builtin_ctz(lanes);
      put_into_lane(batch_.tapes.section(batch_.owner, r_ * Width::lanes + lane, table, each.of[lane]), fields + lane,
                    Width::lanes);
    }
  }

  const LaneBatch& batch_;
  int r_;
  TapedLeapOf<V> leap_;
  unsigned active_ = 0;  ///< a bit for every lane that does not wait for somebody else
};

}  // namespace wormdrive
