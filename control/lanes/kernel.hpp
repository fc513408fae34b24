#pragma once
#include "control/lanes/angles.hpp"
#include "control/lanes/batch.hpp"

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
    const auto rubbing = [&]<bool pid, bool swings>() {
      v.rubs ? take<LaneVariant{false, pid, swings, true}>(batch, sample, end)
             : take<LaneVariant{false, pid, swings, false}>(batch, sample, end);
    };
    const auto loaded = [&]<bool pid>() {
      v.swings ? rubbing.template operator()<pid, true>() : rubbing.template operator()<pid, false>();
    };
    v.pid ? loaded.template operator()<true>() : loaded.template operator()<false>();
  }

 private:
  static_assert(sizeof(LaneTrial<V>) == Width::lanes * sizeof(LaneTrial<double>));

  template <LaneVariant variant>
  [[gnu::noinline]] static void take(const LaneBatch& batch, const LaneSample* sample, const LaneSample* end) {
    auto* const trials = reinterpret_cast<LaneTrial<V>*>(batch.trials);
    for (; sample != end; ++sample)
      for (int r = 0; r < batch.registers; ++r) take<variant>(batch, *sample, r, trials[r]);
  }
  template <LaneVariant variant>
  [[gnu::always_inline]] static void take(const LaneBatch& batch, const LaneSample& sample, int r, LaneTrial<V>& x) {
    const V theta_now = x.theta;
    SineAndCosineOf<V> gear{0.0, 1.0};
    if constexpr (variant.swings) gear = sine_and_cosine(batch, r, theta_now);
    const V shown = variant.ideal ? theta_now : theta_now + x.encoder_share * theta_now + x.encoder_zero;
    const V estimated = variant.swings && batch.estimate_is_aligned
                            ? gear.cosine
                            : sine_and_cosine(batch, r, shown + x.load_angle_offset).cosine;
    const MeasurementOf<V> m{sample.t, shown, x.speed(shown), sample.period, sample.desired};
    const V load = x.load_torque * estimated + x.load_constant;
    const ControlSignalsOf<V> decided = variant.pid ? x.pid(m, load) : x.sliding(m, load);
    V applied = decided.torque;
    if constexpr (!variant.ideal) {
      applied = within_limits<V>(decided.torque, -x.limit, x.limit);
      if (batch.is_delayed) std::swap(applied, x.left);
    }
    const ControlRecordOf<V> record{theta_now, m, decided, applied, 0.0};
    if (sample.counts) x.sums.add(record);
    if (const unsigned loud = set_bits(!x.quiet(record)) & batch.alive[r]) [[unlikely]]
      note(batch, r, loud, record);

    V theta = theta_now, omega = x.omega;
    const HeldTorquesOf<V> held =
        x.drive.template under<variant.ideal>(record.applied + 0.0);  // the motor adds its signal, none
    const SineAndCosineOf<V> arm = of_sum(gear, x.arm_offset);
    const auto known =
        x.drive.held.goes_on(omega, held, arm) &
        x.drive.held.template leap<variant.swings, variant.rubs>(theta, omega, sample.step, held, arm, batch.accuracy);
    const unsigned alone = set_bits(!known) & batch.alive[r];
    if (alone == 0U) [[likely]] {
      x.theta = theta;
      x.omega = omega;
    } else {
      x.theta = select(known, theta, theta_now);
      x.omega = select(known, omega, x.omega);
      go_on(batch, sample, r, alone, record.applied);
    }
  }

  using Each = EachLane<Width>;

  [[gnu::always_inline]] static SineAndCosineOf<V> sine_and_cosine(const LaneBatch& batch, int r, const V& angle) {
    return wormdrive::sine_and_cosine<Width>(angle, batch.alive[r], batch.sine_and_cosine);
  }

  [[gnu::noinline]] static void note(const LaneBatch& batch, int r, unsigned lanes, const ControlRecordOf<V>& record) {
    const Each theta(record.gear_angle), shown(record.measured.angle), speed(record.measured.speed),
        torque(record.decided.torque), s(record.decided.s), u(record.decided.u),
        compensation(record.decided.compensation), applied(record.applied);
    const MeasurementOf<V>& m = record.measured;
    for (; lanes != 0; lanes &= lanes - 1) {
      const int k = __builtin_ctz(lanes);
      batch.note(batch.owner, r * Width::lanes + k,
                 {theta.of[k],
                  {m.t, shown.of[k], speed.of[k], m.period, m.desired},
                  {torque.of[k], s.of[k], u.of[k], compensation.of[k]},
                  applied.of[k],
                  0.0});
    }
  }
  [[gnu::noinline]] static void go_on(const LaneBatch& batch, const LaneSample& sample, int r, unsigned lanes,
                                      const V& torque) {
    const Each torques(torque);
    for (; lanes != 0; lanes &= lanes - 1) {
      const int lane = __builtin_ctz(lanes);
      batch.go_on(batch.owner, r * Width::lanes + lane, sample, torques.of[lane]);
    }
  }
};

}  // namespace wormdrive
