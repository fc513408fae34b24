#pragma once
#include "control/lanes/angles.hpp"
#include "control/lanes/step_batch.hpp"

// Included by one file for each instruction set, as kernel.hpp is.

namespace wormdrive {

/// One step of the drives of one register after the other.
template <class Width>
class StepKernel {
 public:
  using V = Lanes<Width>;

  static void take(const StepBatch& batch) {
    const auto* const drives = reinterpret_cast<const LaneDrive<V>*>(batch.drives);
    for (int r = 0; r < batch.registers; ++r) take(batch, r, drives[r]);
  }

 private:
  static_assert(sizeof(LaneDrive<V>) == Width::lanes * sizeof(LaneDrive<double>));

  [[gnu::always_inline]] static void take(const StepBatch& batch, int r, const LaneDrive<V>& x) {
    const int first = r * Width::lanes;
    const V theta_now = lanes_from<Width>(batch.theta + first), omega_now = lanes_from<Width>(batch.omega + first);
    const V torque = lanes_from<Width>(batch.torque + first);
    V theta = theta_now, omega = omega_now;
    const SineAndCosineOf<V> gear = sine_and_cosine<Width>(theta_now, batch.alive[r], batch.sine_and_cosine);
    const HeldTorquesOf<V> held = x.driven.template under<false>(torque + 0.0);  // the motor adds its signal, none
    const SineAndCosineOf<V> arm = of_sum(gear, x.arm_offset);
    const auto known = x.driven.held.goes_on(omega, held, arm) &
                       x.driven.held.template leap<true, false>(theta, omega, batch.step, held, arm, batch.accuracy);
    const unsigned alive = batch.alive[r], leapt = set_bits(known) & alive;
    const V angle = select(known, theta, theta_now), speed = select(known, omega, omega_now);
    __builtin_memcpy(batch.theta + first, &angle, sizeof angle);
    __builtin_memcpy(batch.omega + first, &speed, sizeof speed);
    if (leapt != alive) [[unlikely]]
      go_on(batch, first, alive & ~leapt, torque);
  }
  [[gnu::noinline]] static void go_on(const StepBatch& batch, int first, unsigned lanes, const V& torque) {
    const EachLane<Width> torques(torque);
    for (; lanes != 0; lanes &= lanes - 1) {
      const int lane = __builtin_ctz(lanes);
      batch.go_on(batch.owner, first + lane, torques.of[lane]);
    }
  }
};

}  // namespace wormdrive
