#pragma once
#include "control/lanes/angles.hpp"
#include "control/lanes/batch.hpp"
#include "control/lanes/taped_plant.hpp"
#include "core/numbers/twice.hpp"
#include "events/taylor/nominal/stribeck.hpp"

// Included by one file for each instruction set, which instantiates it with a type of its own: nothing that is compiled
// for a newer processor may be seen by the rest of the program.

namespace wormdrive {

/// One sample of the trials of one register.
template <class Width>
class LaneKernel {
 public:
  using V = Lanes<Width>;

  static void take(const LaneBatch& batch, const LaneSample* sample, const LaneSample* end) {
    const LaneVariant& v = batch.variant;
    if (v == LaneVariant{}) return take<LaneVariant{}>(batch, sample, end);
    if (v.taped) return LaneKernel<Twice<Width>>::take_taped(batch, sample, end);
    if (v.falls > 0) {  // whatever exponent and bearings
      const auto falling = [&]<bool pid>() {
        v.swings ? take<LaneVariant{.ideal = false, .pid = pid, .rubs = true, .falls = 1}>(batch, sample, end)
                 : take<LaneVariant{.ideal = false, .pid = pid, .swings = false, .rubs = true, .falls = 1}>(
                       batch, sample, end);
      };
      return v.pid ? falling.template operator()<true>() : falling.template operator()<false>();
    }
    const auto rubbing = [&]<bool pid, bool swings>() {
      v.rubs ? take<LaneVariant{false, pid, swings, true}>(batch, sample, end)
             : take<LaneVariant{false, pid, swings, false}>(batch, sample, end);
    };
    const auto loaded = [&]<bool pid>() {
      v.swings ? rubbing.template operator()<pid, true>() : rubbing.template operator()<pid, false>();
    };
    v.pid ? loaded.template operator()<true>() : loaded.template operator()<false>();
  }

  static void take_taped(const LaneBatch& batch, const LaneSample* sample, const LaneSample* end) {
    return batch.variant.pid
               ? take<LaneVariant{.ideal = false, .pid = true, .swings = false, .taped = true}>(batch, sample, end)
               : take<LaneVariant{.ideal = false, .swings = false, .taped = true}>(batch, sample, end);
  }

 private:
  static_assert(sizeof(LaneTrial<V>) == Width::lanes * sizeof(LaneTrial<double>));

  template <LaneVariant variant>
  [[gnu::noinline]] static void take(const LaneBatch& batch, const LaneSample* sample, const LaneSample* end) {
    auto* const trials = reinterpret_cast<LaneTrial<V>*>(batch.trials);
    if constexpr (variant.taped) {  // there is much of a register's: one after the other
      const std::size_t stride = static_cast<std::size_t>(batch.registers) * Width::lanes;
      for (int r = 0; r < batch.registers; ++r) {
        std::size_t at = static_cast<std::size_t>(r) * Width::lanes;  // of what is random
        for (const LaneSample* s = sample; s != end; ++s, at += stride) take<variant>(batch, *s, r, at, trials[r]);
      }
    } else {
      std::size_t at = 0;
      for (; sample != end; ++sample)
        for (int r = 0; r < batch.registers; ++r, at += Width::lanes) take<variant>(batch, *sample, r, at, trials[r]);
    }
  }
  template <LaneVariant variant>
  [[gnu::always_inline]] static void take(const LaneBatch& batch, const LaneSample& sample, int r, std::size_t at,
                                          LaneTrial<V>& x) {
    const V theta_now = x.theta;
    SineAndCosineOf<V> gear{0.0, 1.0};
    if constexpr (variant.swings) gear = sine_and_cosine(batch, r, theta_now);
    const V seen = !variant.ideal && batch.is_late ? x.latched : theta_now;
    V shown = variant.ideal ? seen : seen + x.encoder_share * seen + x.encoder_zero;
    if (!variant.ideal && batch.is_rough) shown = counted(batch, r, at, shown, x.count);
    const V speed = x.speed(shown);
    if (!variant.ideal && batch.is_rough) shown = shown + x.zero_error;
    const V estimated = variant.swings && batch.estimate_is_aligned
                            ? gear.cosine
                            : sine_and_cosine(batch, r, shown + x.load_angle_offset).cosine;
    const MeasurementOf<V> m{sample.t, shown, speed, sample.period, sample.desired};
    const V load = x.load_torque * estimated + x.load_constant;
    const ControlSignalsOf<V> decided = variant.pid ? x.pid(m, load) : x.sliding(m, load);
    V applied = decided.torque;
    if constexpr (!variant.ideal) {
      applied = within_limits<V>(decided.torque, -x.limit, x.limit);
      if (batch.is_delayed) std::swap(applied, x.left);
    }
    const V disturbance = !variant.ideal && batch.disturbance ? lanes_from<Width>(batch.disturbance + at) : V(0.0);
    const ControlRecordOf<V> record{theta_now, m, decided, applied, disturbance};
    if (sample.counts) x.sums.add(record);
    if (const unsigned loud = set_bits(!x.quiet(record)) & batch.alive[r]) [[unlikely]]
      note(batch, r, loud, record);

    V theta = theta_now, omega = x.omega;
    const V command = record.applied + 0.0;  // the motor adds its signal, none
    LaneMask<Width> known;
    if constexpr (variant.taped) {
      known = TapedPlant<Width>(batch, r).step(sample, x, theta, omega, command, disturbance);
    } else {
      const HeldTorquesOf<V> held = torques_under<variant>(batch, x, command, disturbance);
      const SineAndCosineOf<V> arm = of_sum(gear, x.arm_offset);
      if (variant.ideal || batch.variant.response == MotorResponse::at_once) [[likely]] {
        known = leap<variant>(batch, x, theta, omega, sample.step, held, arm);
        if ((set_bits(!known) & batch.alive[r]) != 0U) [[unlikely]]
          known = leap_on_other_flank<variant>(batch, sample, x, known, theta, omega, command, disturbance, arm);
        if (!variant.ideal && batch.is_late) latch<variant>(batch, sample, x, command, disturbance, arm);
      } else if (batch.variant.response == MotorResponse::after_delay) {
        known = leap_after_delay<variant>(batch, sample, r, x, theta, omega, command, disturbance, held, arm);
      } else if constexpr (!variant.rubs && variant.falls == 0) {
        known = leap_with_lag<variant>(batch, sample, x, theta, omega, command, held, arm);
      }
    }
    const unsigned alone = set_bits(!known) & batch.alive[r];
    if (alone == 0U) [[likely]] {
      x.theta = theta;
      x.omega = omega;
    } else {
      x.theta = select(known, theta, theta_now);
      x.omega = select(known, omega, x.omega);
      go_on(batch, sample, r, alone, record);
    }
  }

  template <LaneVariant variant>
  [[gnu::always_inline]] static HeldTorquesOf<V> torques_under(const LaneBatch& batch, const LaneTrial<V>& x,
                                                               const V& command, const V& disturbance) {
    return !variant.ideal && batch.disturbance ? x.mode.drive.under(command, disturbance)
                                               : x.mode.drive.template under<variant.ideal>(command);
  }
  /// One step by a formula, where it is certain beforehand.
  template <LaneVariant variant, class H>
  [[gnu::always_inline]] static LaneMask<Width> leap(const LaneBatch& batch, const LaneTrial<V>& x, V& theta, V& omega,
                                                     const H& h, const HeldTorquesOf<V>& held,
                                                     const SineAndCosineOf<V>& arm) {
    const HeldMotionOf<V>& m = x.mode.drive.held;
    const LaneMask<Width> goes_on = m.goes_on(omega, held, arm);
    if constexpr (variant.falls > 0) {
      const FallOf<V> fall{x.mode.pull,       x.mode.bend,         x.per_speed,
                           1.0 / x.per_speed, batch.variant.falls, batch.variant.falls_with_tail};
      return goes_on &
             FallingLeap<V>::template take<variant.swings>(m, fall, theta, omega, h, held, arm, batch.accuracy);
    } else {
      return goes_on & m.template leap<variant.swings, variant.rubs>(theta, omega, h, held, arm, batch.accuracy);
    }
  }
  /// Takes the angle that the next sample sees; where the step is not known, it does not count.
  template <LaneVariant variant>
  [[gnu::noinline]] static void latch(const LaneBatch& batch, const LaneSample& sample, LaneTrial<V>& x,
                                      const V& command, const V& disturbance, const SineAndCosineOf<V>& arm) {
    V speed = x.omega;
    x.latched = x.theta;
    leap<variant>(batch, x, x.latched, speed, (sample.next - x.age) - sample.t,
                  torques_under<variant>(batch, x, command, disturbance), arm);
  }
  /// A step where a new torque lets the other flank carry: there the trial goes over to the mode across the surface.
  /// Returns where the step is known after all.
  template <LaneVariant variant>
  [[gnu::noinline]] static LaneMask<Width> leap_on_other_flank(const LaneBatch& batch, const LaneSample& sample,
                                                               LaneTrial<V>& x, const LaneMask<Width>& known, V& theta,
                                                               V& omega, const V& command, const V& disturbance,
                                                               const SineAndCosineOf<V>& arm) {
    const LaneMask<Width> crossed =
        (!known) &
        x.mode.drive.held.changes_flank(x.omega, torques_under<variant>(batch, x, command, disturbance), arm);
    if (!any(crossed)) return known;
    change_mode(x, crossed);
    V angle = x.theta, speed = x.omega;
    const LaneMask<Width> leapt = crossed & leap<variant>(batch, x, angle, speed, sample.step,
                                                          torques_under<variant>(batch, x, command, disturbance), arm);
    theta = select(leapt, angle, theta);
    omega = select(leapt, speed, omega);
    change_mode(x, crossed & !leapt);
    x.count_flank_changes(leapt, sample.counts);
    return known | leapt;
  }
  static void change_mode(LaneTrial<V>& x, const LaneMask<Width>& which) {
    swap_where<V>(which, reinterpret_cast<V*>(&x.mode), reinterpret_cast<V*>(&x.across), sizeof x.mode / sizeof(V));
  }

  /// Two steps: under the torque of the command before, and under that of this one, held, from when it arrives.
  template <LaneVariant variant>
  [[gnu::noinline]] static LaneMask<Width> leap_after_delay(const LaneBatch& batch, const LaneSample& sample, int r,
                                                            LaneTrial<V>& x, V& theta, V& omega, const V& command,
                                                            const V& disturbance, const HeldTorquesOf<V>& held,
                                                            const SineAndCosineOf<V>& arm) {
    const V arrival = sample.t + x.behind;
    const LaneMask<Width> is_within =
        (arrival > V(sample.t)) & (arrival < V(sample.next)) & (V(sample.step) > V(0.0));  // not where all go on alone
    LaneMask<Width> known = is_within & leap<variant>(batch, x, theta, omega, arrival - sample.t,
                                                      torques_under<variant>(batch, x, x.torque, disturbance), arm);
    const SineAndCosineOf<V> then =
        variant.swings ? of_sum(sine_and_cosine(batch, r, theta), x.arm_offset) : SineAndCosineOf<V>{0.0, 1.0};
    known = known & leap<variant>(batch, x, theta, omega, sample.next - arrival, held, then);
    x.torque = select(known, command, x.torque);
    return known;
  }
  /// One step without drag while the torque before decays.
  template <LaneVariant variant>
  [[gnu::noinline]] static LaneMask<Width> leap_with_lag(const LaneBatch& batch, const LaneSample& sample,
                                                         LaneTrial<V>& x, V& theta, V& omega, const V& command,
                                                         const HeldTorquesOf<V>& held, const SineAndCosineOf<V>& arm) {
    const V left = x.torque - command;
    const DrivenMotionOf<V>& drive = x.mode.drive;
    const LaggingTorqueOf<V> lagging{drive.of_decaying(left), DecayOf<V>(sample.step / x.behind)};
    const LaneMask<Width> known =
        drive.held.goes_on(omega, held + lagging.left, arm) &
        drive.held.template leap<variant.swings>(theta, omega, sample.step, held, lagging, arm, batch.accuracy);
    x.torque = select(known, command + left * lagging.decay.left(), x.torque);
    return known;
  }

  /// What encoders show of angles: with noise, then rounded to counts.
  [[gnu::always_inline]] static V counted(const LaneBatch& batch, int r, std::size_t at, V angle, const V& count) {
    if (batch.noise) angle = angle + lanes_from<Width>(batch.noise + at);
    const V counts = angle / count + 0.5;
    constexpr double whole = 0x1.8p52;  // numbers of this size have no fraction
    const V nearest = (counts + whole) - whole;
    V below = select(nearest > counts, nearest - 1.0, nearest);
    if (const unsigned far = set_bits(!(abs(counts) < V(0x1p51))) & batch.alive[r]) [[unlikely]]
      below = floor_of_each(counts, below, far);
    return select(count < V(std::numeric_limits<double>::infinity()), count * below, angle);
  }
  [[gnu::noinline]] static V floor_of_each(const V& x, const V& near, unsigned lanes) {
    const Each each(x);
    Each below(near);
    for (; lanes != 0; lanes &= lanes - 1) {
      const int k = __builtin_ctz(lanes);
      below.of[k] = __builtin_floor(each.of[k]);
    }
    return lanes_from<Width>(below.of);
  }

  using Each = EachLane<Width>;

  [[gnu::always_inline]] static SineAndCosineOf<V> sine_and_cosine(const LaneBatch& batch, int r, const V& angle) {
    return wormdrive::sine_and_cosine<Width>(angle, batch.alive[r], batch.sine_and_cosine);
  }

  [[gnu::noinline]] static void note(const LaneBatch& batch, int r, unsigned lanes, const ControlRecordOf<V>& record) {
    const Each theta(record.gear_angle), shown(record.measured.angle), speed(record.measured.speed),
        torque(record.decided.torque), s(record.decided.s), u(record.decided.u),
        compensation(record.decided.compensation), applied(record.applied), disturbance(record.disturbance);
    const MeasurementOf<V>& m = record.measured;
    for (; lanes != 0; lanes &= lanes - 1) {
      const int k = __builtin_ctz(lanes);
      batch.note(batch.owner, r * Width::lanes + k,
                 {theta.of[k],
                  {m.t, shown.of[k], speed.of[k], m.period, m.desired},
                  {torque.of[k], s.of[k], u.of[k], compensation.of[k]},
                  applied.of[k],
                  disturbance.of[k]});
    }
  }
  [[gnu::noinline]] static void go_on(const LaneBatch& batch, const LaneSample& sample, int r, unsigned lanes,
                                      const ControlRecordOf<V>& record) {
    const Each torques(record.applied), disturbances(record.disturbance);
    for (; lanes != 0; lanes &= lanes - 1) {
      const int lane = __builtin_ctz(lanes);
      batch.go_on(batch.owner, r * Width::lanes + lane, sample, torques.of[lane], disturbances.of[lane]);
    }
  }
};

}  // namespace wormdrive
