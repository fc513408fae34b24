#pragma once
#include <cstring>

#include "core/numbers/lanes.hpp"
#include "core/numbers/sine_cosine.hpp"

// For kernels only, which are compiled for instruction sets of their own.

namespace wormdrive {

/// Trials of a register alone, in memory.
template <class Width>
struct EachLane {
  alignas(64) double of[Width::lanes];
  explicit EachLane(const Lanes<Width>& v) { __builtin_memcpy(of, &v, sizeof of); }
};

/// The numbers of a register as they stand in memory.
template <class Width>
[[gnu::always_inline]] inline Lanes<Width> lanes_from(const double* memory) {
  Lanes<Width> v;
  __builtin_memcpy(&v, memory, sizeof v);
  return v;
}

/// Sine and cosine of any angle, as a trial alone has them.
using SineAndCosineAlone = SineAndCosine (*)(double angle);

template <class Width>
[[gnu::noinline]] SineAndCosineOf<Lanes<Width>> far_sine_and_cosine(const Lanes<Width>& angle,
                                                                    const SineAndCosineOf<Lanes<Width>>& near,
                                                                    unsigned lanes, SineAndCosineAlone alone) {
  EachLane<Width> angles(angle), sine(near.sine), cosine(near.cosine);
  for (; lanes != 0; lanes &= lanes - 1) {
    const int lane = __builtin_ctz(lanes);
    const SineAndCosine found = alone(angles.of[lane]);
    sine.of[lane] = found.sine;
    cosine.of[lane] = found.cosine;
  }
  SineAndCosineOf<Lanes<Width>> all;
  __builtin_memcpy(&all.sine, sine.of, sizeof sine.of);
  __builtin_memcpy(&all.cosine, cosine.of, sizeof cosine.of);
  return all;
}

/// Sine and cosine of the angles of a register, those of the lanes that are alive to the bits that they would have
/// alone.
template <class Width>
[[gnu::always_inline]] inline SineAndCosineOf<Lanes<Width>> sine_and_cosine(const Lanes<Width>& angle, unsigned alive,
                                                                            SineAndCosineAlone alone) {
  using V = Lanes<Width>;
  const unsigned distant = set_bits(!(abs(angle) < V(quarter_turn::furthest))) & alive;
  const Both<V> found = quarter_turn::within(angle);
  if (distant == 0U) [[likely]]
    return {found[0], found[1]};
  return far_sine_and_cosine<Width>(angle, {found[0], found[1]}, distant, alone);
}

}  // namespace wormdrive
